/* Which call is allowed where: all calls in all phases. A refused one says so and changes nothing. */
#include "check.h"

#include <stdlib.h>
#include <string.h>

/* The phases of both kinds of interface. */
enum { INSTANTIATED = 1, INITIALIZATION = 2, EVENT = 4, CONTINUOUS = 8, STEP = 16, TERMINATED = 32 };
enum { RUNNING = EVENT | CONTINUOUS | STEP, ALIVE = INSTANTIATED | INITIALIZATION | RUNNING, ALWAYS = ALIVE | TERMINATED };
enum { EVALUATES = INITIALIZATION | EVENT | CONTINUOUS | TERMINATED };

static double *numbers;

static int set_input(void *c) {
    uint32_t vr = reference("bolster_z");
    double value = 1e-4;
    return api->set(c, &vr, 1, &value);
}
static int set_fixed(void *c) {
    uint32_t vr = reference("wedge_mass");
    double value = 20.0;
    return api->set(c, &vr, 1, &value);
}
static int set_tunable(void *c) {
    uint32_t vr = reference("column_friction");
    double value = 0.3;
    return api->set(c, &vr, 1, &value);
}
static int set_option(void *c) {
    uint32_t vr = reference("start");
    int32_t value = 2;
    return api->set_integer(c, &vr, 1, &value);
}
static int set_switch(void *c) {
    uint32_t vr = reference("derive_rates");
    int value = 1;
    return api->set_boolean(c, &vr, 1, &value);
}
static int get_output(void *c) {
    uint32_t vr = reference("force_on_bolster_z");
    return api->get(c, &vr, 1, numbers);
}
static int get_mode(void *c) {
    uint32_t vr = reference("column_lower_right_state");
    int32_t value;
    return api->get_integer(c, &vr, 1, &value);
}
static int get_switch(void *c) {
    uint32_t vr = reference("inputs_at_end");
    int value;
    return api->get_boolean(c, &vr, 1, &value);
}
static int along(void *c) {
    uint32_t unknown = reference("force_on_bolster_z"), known = reference("bolster_z");
    double seed = 1.0;
    return api->along(c, &unknown, 1, &known, 1, &seed, numbers);
}
static int step(void *c) { return api->step(c, 0.0, 1e-3); }
static int set_time(void *c) { return api->set_time(c, 1e-3); }
static int states(void *c) { return api->states(c, numbers, state_count); }
static int set_states(void *c) {
    for (size_t i = 0; i < state_count; i += 1) numbers[i] = 0.0;
    return api->set_states(c, numbers, state_count);
}
static int rates(void *c) { return api->rates(c, numbers, state_count); }
static int indicators(void *c) { return api->indicators(c, numbers, indicator_count); }
static int nominals(void *c) { return api->nominals(c, numbers, state_count); }

static int enter(void *c) { return api->enter_initialization(c); }
static int leave(void *c) { return api->exit_initialization(c); }
static int terminate(void *c) { return api->terminate(c); }
static int reset(void *c) { return api->reset(c); }
static int event_mode(void *c) { return api->event_mode(c); }
static int discrete_states(void *c) { return api->discrete_states(c); }
static int continuous_mode(void *c) { return api->continuous_mode(c); }
static int completed_step(void *c) { return api->completed_step(c); }

static const struct {
    const char *name;
    int (*call)(void *);
    int allowed;
} calls[] = {
    {"enter initialization", enter, INSTANTIATED},
    {"exit initialization", leave, INITIALIZATION},
    {"terminate", terminate, RUNNING},
    {"reset", reset, ALWAYS},
    {"set an input", set_input, ALIVE},
    {"set a fixed parameter", set_fixed, INSTANTIATED | INITIALIZATION},
    {"set a tunable parameter", set_tunable, ALIVE & ~CONTINUOUS},
    {"set an option", set_option, INSTANTIATED | INITIALIZATION},
    {"set a switch", set_switch, INSTANTIATED | INITIALIZATION},
    {"get an output", get_output, ALWAYS},
    {"get a contact state", get_mode, ALWAYS},
    {"get a switch", get_switch, ALWAYS},
    {"derivatives", along, INITIALIZATION | RUNNING | TERMINATED},
    {"step", step, STEP},
    {"event mode", event_mode, EVENT | CONTINUOUS},
    {"discrete states", discrete_states, EVENT},
    {"continuous-time mode", continuous_mode, EVENT | CONTINUOUS},
    {"completed step", completed_step, CONTINUOUS},
    {"set time", set_time, EVENT | CONTINUOUS},
    {"set states", set_states, EVENT | CONTINUOUS},
    {"states", states, EVALUATES},
    {"rates", rates, EVALUATES},
    {"indicators", indicators, EVALUATES},
    {"nominals", nominals, EVALUATES | INSTANTIATED},
};

/* What belongs to model exchange alone is refused by an instance of co-simulation even where the phases have the same names. */
static int only_exchange(int (*call)(void *)) {
    return call == states || call == rates || call == indicators || call == nominals;
}

/* The instance as bytes. */
static char *bytes(void *c, size_t *size) {
    void *state = NULL;
    EXPECT(api->save(c, &state) == OK);
    EXPECT(api->size(c, state, size) == OK);
    char *text = room(*size);
    EXPECT(api->serialize(c, state, text, *size) == OK);
    EXPECT(api->free_state(c, &state) == OK);
    EXPECT(state == NULL);
    return text;
}

static void try_all(void *c, int phase, int exchange) {
    void *here = NULL;
    EXPECT(api->save(c, &here) == OK);
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i += 1) {
        int allowed = (calls[i].allowed & phase) && (exchange || !only_exchange(calls[i].call));
        size_t size, size_after;
        char *before = bytes(c, &size);
        long said = messages;
        int status = calls[i].call(c);
        char *after = bytes(c, &size_after);
        if (allowed) {
            expect(status == OK, calls[i].name, "allowed in phase", phase);
        } else {
            expect(status == ERROR, calls[i].name, "refused in phase", phase);
            expect(messages > said, calls[i].name, "message in phase", phase);
            expect(size == size_after && memcmp(before, after, size) == 0, calls[i].name, "nothing changes in phase", phase);
        }
        free(before);
        free(after);
        EXPECT(api->restore(c, here) == OK);
    }
    EXPECT(api->free_state(c, &here) == OK);
}

void check_phases(int exchange) {
    numbers = room((state_count + indicator_count + 1) * sizeof *numbers);
    void *c = made(exchange);
    try_all(c, INSTANTIATED, exchange);
    EXPECT(api->enter_initialization(c) == OK);
    try_all(c, INITIALIZATION, exchange);
    EXPECT(api->exit_initialization(c) == OK);
    if (exchange) {
        try_all(c, EVENT, exchange);
        EXPECT(api->discrete_states(c) == OK);
        EXPECT(api->continuous_mode(c) == OK);
        try_all(c, CONTINUOUS, exchange);
    } else {
        try_all(c, STEP, exchange);
    }
    EXPECT(api->terminate(c) == OK);
    try_all(c, TERMINATED, exchange);
    /* Reset and free without an end. */
    EXPECT(api->reset(c) == OK);
    EXPECT(api->enter_initialization(c) == OK);
    api->free_instance(c);
    free(numbers);
}
