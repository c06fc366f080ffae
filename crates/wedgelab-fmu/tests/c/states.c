/* Saved states: there and back, as bytes, cut off, damaged, of the other kind, null. */
#include "check.h"

#include <stdlib.h>
#include <string.h>

static void use(void *c) {
    const uint32_t outputs[2] = {reference("force_on_bolster_z"), reference("ledger_residual")};
    double values[2];
    int status = api->get(c, outputs, 2, values);
    EXPECT(status == OK || status == ERROR);
    status = api->terminate(c);
    EXPECT(status == OK || status == ERROR);
}

/* Bytes that are no state, or another one: refused, or taken, but never a crash. */
static void damage(void *c, const char *bytes, size_t size, int corruptions) {
    uint32_t chance = 12345;
    int refused = 0;
    for (int k = 0; k < corruptions; k += 1) {
        /* Two of three: cut off; one of three: some bytes changed. */
        size_t length = k % 3 == 0 ? size * (size_t)k / (size_t)corruptions : size;
        char *copy = room(length);
        memcpy(copy, bytes, length);
        for (int n = 0; k % 3 != 0 && n < k % 4 + 1 && length; n += 1) {
            chance = chance * 1664525u + 1013904223u;
            size_t place = (size_t)(chance >> 8) % length;
            /* Digits make other values, anything else mostly other words. */
            copy[place] = k % 3 == 1 ? (char)('0' + (chance & 7)) : (char)(chance >> 16);
        }
        void *state = NULL;
        int status = api->deserialize(c, copy, length, &state);
        EXPECT(status == OK || status == ERROR);
        EXPECT((status == OK) == (state != NULL));
        if (status == OK) {
            status = api->restore(c, state);
            EXPECT(status == OK || status == ERROR);
            use(c);
            EXPECT(api->free_state(c, &state) == OK);
        }
        refused += status == ERROR;
        free(copy);
    }
    EXPECT(refused > corruptions / 3);
}

void check_states(int corruptions) {
    double first[6], second[6];
    void *c = made(0), *state = NULL, *early = NULL;
    EXPECT(api->save(c, &early) == OK);
    EXPECT(api->enter_initialization(c) == OK);
    EXPECT(api->exit_initialization(c) == OK);
    drive(c, 0, 10, 0.05, first);
    EXPECT(api->save(c, &state) == OK);
    drive(c, 10, 25, 0.05, first);
    EXPECT(api->restore(c, state) == OK);
    drive(c, 10, 25, 0.05, second);
    EXPECT(memcmp(first, second, sizeof first) == 0);

    /* As bytes, into another instance, also into one that has not begun. */
    size_t size = 0;
    EXPECT(api->size(c, state, &size) == OK && size > 0);
    char *bytes = room(size);
    REFUSED(api->serialize(c, state, bytes, size - 1));
    REFUSED(api->serialize(c, state, NULL, size));
    REFUSED(api->serialize(c, NULL, bytes, size));
    REFUSED(api->size(c, NULL, &size));
    REFUSED(api->size(c, state, NULL));
    EXPECT(api->serialize(c, state, bytes, size) == OK);
    void *other = made(0), *copy = NULL;
    EXPECT(api->deserialize(other, bytes, size, &copy) == OK && copy != NULL);
    EXPECT(api->restore(other, copy) == OK);
    drive(other, 10, 25, 0.05, second);
    EXPECT(memcmp(first, second, sizeof first) == 0);
    /* Into more room than needed and back. */
    char *large = room(size + 100);
    EXPECT(api->serialize(c, state, large, size + 100) == OK);
    EXPECT(api->free_state(other, &copy) == OK && copy == NULL);
    EXPECT(api->deserialize(other, large, size + 100, &copy) == OK);
    EXPECT(api->restore(other, copy) == OK);
    free(large);

    /* A state is overwritten in its place, and outlives what was done since. */
    EXPECT(api->save(c, &copy) == OK);
    EXPECT(api->restore(c, early) == OK);
    REFUSED(api->step(c, 0.0, 1e-3));
    EXPECT(api->enter_initialization(c) == OK);
    EXPECT(api->exit_initialization(c) == OK);
    EXPECT(api->restore(c, copy) == OK);

    /* Null pointers, and states of the other kind of interface. */
    REFUSED(api->save(c, NULL));
    REFUSED(api->restore(c, NULL));
    REFUSED(api->deserialize(c, NULL, size, &copy));
    REFUSED(api->deserialize(c, bytes, size, NULL));
    void *nothing = NULL;
    REFUSED(api->deserialize(c, bytes, 0, &nothing));
    EXPECT(nothing == NULL);
    EXPECT(api->free_state(c, NULL) == OK);
    EXPECT(api->free_state(c, &nothing) == OK);
    EXPECT(api->free_state(c, &nothing) == OK);
    /* States that were freed, and pointers that lead to none. */
    void *freed = NULL, *again;
    EXPECT(api->save(c, &freed) == OK);
    again = freed;
    EXPECT(api->free_state(c, &again) == OK && again == NULL);
    again = freed;
    REFUSED(api->free_state(c, &again));
    REFUSED(api->restore(c, freed));
    REFUSED(api->size(c, freed, &size));
    REFUSED(api->save(c, &again));
    REFUSED(api->restore(c, c));
    void *exchange = started(1);
    REFUSED(api->restore(exchange, state));
    EXPECT(api->free_state(exchange, &copy) == OK);
    EXPECT(api->save(exchange, &copy) == OK);
    REFUSED(api->restore(c, copy));
    EXPECT(api->size(exchange, copy, &size) == OK);

    /* Damaged bytes of both kinds; then everything is as before. */
    char *exchange_bytes = room(size);
    EXPECT(api->serialize(exchange, copy, exchange_bytes, size) == OK);
    damage(exchange, exchange_bytes, size, corruptions);
    EXPECT(api->size(c, state, &size) == OK);
    damage(other, bytes, size, corruptions);
    EXPECT(api->restore(other, state) == OK);
    drive(other, 10, 25, 0.05, second);
    EXPECT(memcmp(first, second, sizeof first) == 0);

    free(bytes), free(exchange_bytes);
    EXPECT(api->free_state(exchange, &copy) == OK);
    EXPECT(api->free_state(c, &early) == OK);
    api->free_instance(exchange);
    api->free_instance(other);
    /* A state may be freed through any instance, also after its own has gone. */
    void *fresh = made(0);
    api->free_instance(c);
    EXPECT(api->restore(fresh, state) == OK);
    drive(fresh, 10, 25, 0.05, second);
    EXPECT(memcmp(first, second, sizeof first) == 0);
    EXPECT(api->free_state(fresh, &state) == OK);
    api->free_instance(fresh);
}
