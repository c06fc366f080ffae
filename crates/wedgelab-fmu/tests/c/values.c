/* Bad values, references, pointers and steps; several instances at once; derivatives. */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Every call without an instance is an error and nothing else. */
void check_nobody(void) {
    uint32_t vr = 0;
    double number = 0.0;
    int32_t integer = 0;
    int truth = 0;
    void *state = NULL;
    size_t size = 0;
    char byte = 0;
    EXPECT(api->enter_initialization(NULL) == ERROR);
    EXPECT(api->exit_initialization(NULL) == ERROR);
    EXPECT(api->terminate(NULL) == ERROR);
    EXPECT(api->reset(NULL) == ERROR);
    EXPECT(api->get(NULL, &vr, 1, &number) == ERROR);
    EXPECT(api->set(NULL, &vr, 1, &number) == ERROR);
    EXPECT(api->get_integer(NULL, &vr, 1, &integer) == ERROR);
    EXPECT(api->set_integer(NULL, &vr, 1, &integer) == ERROR);
    EXPECT(api->get_boolean(NULL, &vr, 1, &truth) == ERROR);
    EXPECT(api->set_boolean(NULL, &vr, 1, &truth) == ERROR);
    EXPECT(api->step(NULL, 0.0, 1e-3) == ERROR);
    EXPECT(api->save(NULL, &state) == ERROR);
    EXPECT(api->restore(NULL, NULL) == ERROR);
    EXPECT(api->free_state(NULL, &state) == ERROR);
    EXPECT(api->size(NULL, NULL, &size) == ERROR);
    EXPECT(api->serialize(NULL, NULL, &byte, 1) == ERROR);
    EXPECT(api->deserialize(NULL, &byte, 1, &state) == ERROR);
    EXPECT(api->along(NULL, &vr, 1, &vr, 1, &number, &number) == ERROR);
    EXPECT(api->event_mode(NULL) == ERROR);
    EXPECT(api->discrete_states(NULL) == ERROR);
    EXPECT(api->continuous_mode(NULL) == ERROR);
    EXPECT(api->completed_step(NULL) == ERROR);
    EXPECT(api->set_time(NULL, 0.0) == ERROR);
    EXPECT(api->set_states(NULL, &number, 1) == ERROR);
    EXPECT(api->rates(NULL, &number, 1) == ERROR);
    EXPECT(api->indicators(NULL, &number, 1) == ERROR);
    EXPECT(api->states(NULL, &number, 1) == ERROR);
    EXPECT(api->nominals(NULL, &number, 1) == ERROR);
    EXPECT(state == NULL);
    api->free_instance(NULL);
}

/* What no instance can be made from: null, and a message. */
void check_instantiation(void) {
    for (int exchange = 0; exchange < 2; exchange += 1) {
        const struct {
            const char *name, *token, *resources;
        } bad[] = {
            {NULL, token, resources},
            {"wedge", NULL, resources},
            {"wedge", token, NULL},
            {"wedge", "{00000000-0000-0000-0000-000000000000}", resources},
            {"wedge", "", resources},
            {"wedge", "\xff\xfe", resources},
            {"wedge", token, ""},
            {"wedge", token, "/there/is/no/such/folder"},
            {"wedge", token, "file:///there/is/no/such/folder"},
            {"wedge", token, "ftp://somewhere/else"},
            {"wedge", token, "file:///%zz"},
            {"wedge", token, "file://"},
            {"\xff", token, resources},
        };
        for (size_t i = 0; i < sizeof bad / sizeof *bad; i += 1) {
            long before = messages;
            EXPECT(api->instantiate(exchange, bad[i].name, bad[i].token, bad[i].resources) == NULL);
            EXPECT(messages > before);
        }
        /* A name may be anything else: it is no format of printf and no path. */
        void *c = api->instantiate(exchange, "100%s %n ../\"<wedge>", token, resources);
        EXPECT(c != NULL);
        REFUSED(api->exit_initialization(c));
        api->free_instance(c);
        /* Freed before anything else. */
        api->free_instance(made(exchange));
    }
}

void check_values(void) {
    const uint32_t input = reference("bolster_z"), output = reference("force_on_bolster_z"), mass = reference("wedge_mass"),
                   mode = reference("column_lower_right_state"), option = reference("coil_mode"),
                   truth_reference = reference("derive_rates"), unknown = NOBODY, last = UINT32_MAX;
    const double numbers[] = {NAN, INFINITY, -INFINITY};
    const double good = 1e-4;
    double number = 0.0;
    int32_t integer = 0, far = 77;
    int truth = 1;
    void *c = made(0);
    /* Values with which there is no wedge are refused when it is asked for, and can be mended. */
    const double negative = -1.0, pounds = 22.7;
    EXPECT(api->set(c, &mass, 1, &negative) == OK);
    REFUSED(api->get(c, &output, 1, &number));
    EXPECT(api->enter_initialization(c) == OK);
    REFUSED(api->exit_initialization(c));
    EXPECT(api->set(c, &mass, 1, &pounds) == OK);
    EXPECT(api->exit_initialization(c) == OK);
    REFUSED(api->set(c, &mass, 1, &pounds));
    for (int i = 0; i < 3; i += 1) REFUSED(api->set(c, &input, 1, &numbers[i]));
    REFUSED(api->set(c, &output, 1, &good));
    REFUSED(api->set(c, &mode, 1, &good));
    REFUSED(api->set(c, &unknown, 1, &good));
    REFUSED(api->set(c, &last, 1, &good));
    REFUSED(api->get(c, &unknown, 1, &number));
    REFUSED(api->get(c, &last, 1, &number));
    REFUSED(api->get(c, &mode, 1, &number));
    REFUSED(api->get_integer(c, &input, 1, &integer));
    REFUSED(api->get_integer(c, &unknown, 1, &integer));
    REFUSED(api->get_boolean(c, &option, 1, &truth));
    REFUSED(api->get_boolean(c, &unknown, 1, &truth));
    REFUSED(api->set_integer(c, &option, 1, &far));
    REFUSED(api->set_integer(c, &mode, 1, &integer));
    REFUSED(api->set_boolean(c, &truth_reference, 1, &truth));
    /* Null pointers. */
    REFUSED(api->get(c, NULL, 1, &number));
    REFUSED(api->get(c, &output, 1, NULL));
    REFUSED(api->set(c, NULL, 1, &good));
    REFUSED(api->set(c, &input, 1, NULL));
    REFUSED(api->get_integer(c, NULL, 1, &integer));
    REFUSED(api->get_integer(c, &mode, 1, NULL));
    REFUSED(api->set_integer(c, NULL, 1, &integer));
    REFUSED(api->set_integer(c, &option, 1, NULL));
    REFUSED(api->get_boolean(c, NULL, 1, &truth));
    REFUSED(api->set_boolean(c, NULL, 1, &truth));
    /* Nothing at all is no error. */
    EXPECT(api->get(c, NULL, 0, NULL) == OK);
    EXPECT(api->set(c, NULL, 0, NULL) == OK);
    EXPECT(api->get_integer(c, NULL, 0, NULL) == OK);
    EXPECT(api->set_integer(c, NULL, 0, NULL) == OK);
    EXPECT(api->get_boolean(c, NULL, 0, NULL) == OK);
    EXPECT(api->set_boolean(c, NULL, 0, NULL) == OK);
    /* A list of which one is bad changes none of them. */
    const uint32_t both[2] = {input, unknown};
    const double pair[2] = {0.01, 0.01};
    REFUSED(api->set(c, both, 2, pair));
    EXPECT(api->get(c, &input, 1, &number) == OK && number != 0.01);
    const uint32_t two[2] = {input, reference("bolster_x")};
    const double half[2] = {0.01, NAN};
    REFUSED(api->set(c, two, 2, half));
    EXPECT(api->get(c, &input, 1, &number) == OK && number != 0.01);
    /* Friction may change between steps, but not to what is none. */
    const uint32_t friction = reference("column_friction");
    const double less = 0.3;
    REFUSED(api->set(c, &friction, 1, &negative));
    EXPECT(api->set(c, &friction, 1, &less) == OK);
    EXPECT(api->get(c, &friction, 1, &number) == OK && number == less);
    /* Finite, but far beyond all sense: an error or a step, and then the instance can be reset. */
    const double far_away = 1e300;
    EXPECT(api->set(c, &input, 1, &far_away) == OK);
    int status = api->step(c, 0.0, 1e-3);
    EXPECT(status == OK || status == ERROR);
    status = api->get(c, &output, 1, &number);
    EXPECT(status == OK || status == ERROR);
    EXPECT(api->reset(c) == OK);
    EXPECT(api->enter_initialization(c) == OK);
    EXPECT(api->exit_initialization(c) == OK);
    EXPECT(api->step(c, 0.0, 1e-3) == OK);
    api->free_instance(c);
}

void check_steps(void) {
    const uint32_t time = reference("time");
    double now = -1.0;
    void *c = started(0);
    REFUSED(api->step(c, 0.0, -1e-3));
    REFUSED(api->step(c, 0.0, 0.0));
    REFUSED(api->step(c, 0.0, NAN));
    REFUSED(api->step(c, 0.0, INFINITY));
    REFUSED(api->step(c, NAN, 1e-3));
    REFUSED(api->step(c, 1.0, 1e-3));
    REFUSED(api->step(c, -1.0, 1e-3));
    EXPECT(api->get(c, &time, 1, &now) == OK && now == 0.0);
    /* Steps of any length, and none after the end. */
    EXPECT(api->step(c, 0.0, 1e-9) == OK);
    EXPECT(api->step(c, 1e-9, 0.02) == OK);
    EXPECT(api->get(c, &time, 1, &now) == OK && fabs(now - 0.02) < 1e-8);
    EXPECT(api->terminate(c) == OK);
    REFUSED(api->step(c, now, 1e-3));
    REFUSED(api->terminate(c));
    EXPECT(api->reset(c) == OK);
    api->free_instance(c);
}

/* Directional derivatives of everything that has some, against central differences of the same calls. */
void check_derivatives(void) {
    const char *knowns[] = {"bolster_x", "bolster_z", "bolster_z_rate", "bolster_yaw", "side_frame_z", "side_frame_x_rate"};
    const char *unknowns[] = {"force_on_bolster_x",  "force_on_bolster_z", "moment_on_bolster_yaw", "force_on_side_frame_x",
                              "force_on_side_frame_z", "coil_force",       "column_normal_force",   "der(wedge_z_rate)",
                              "der(wedge_x_rate)"};
    enum { KNOWNS = 6, UNKNOWNS = 9 };
    uint32_t from[KNOWNS], of[UNKNOWNS];
    for (int i = 0; i < KNOWNS; i += 1) from[i] = reference(knowns[i]);
    for (int i = 0; i < UNKNOWNS; i += 1) of[i] = reference(unknowns[i]);
    void *c = made(1);
    const uint32_t start = reference("start");
    const int32_t equilibrium = 2;
    EXPECT(api->set_integer(c, &start, 1, &equilibrium) == OK);
    EXPECT(api->enter_initialization(c) == OK);
    EXPECT(api->exit_initialization(c) == OK);
    EXPECT(api->continuous_mode(c) == OK);
    for (int k = 0; k < KNOWNS; k += 1) {
        const double one = 1.0, h = 1e-9;
        double here, exact[UNKNOWNS], more[UNKNOWNS], less[UNKNOWNS], largest = 0.0;
        EXPECT(api->get(c, &from[k], 1, &here) == OK);
        EXPECT(api->along(c, of, UNKNOWNS, &from[k], 1, &one, exact) == OK);
        double up = here + h, down = here - h;
        EXPECT(api->set(c, &from[k], 1, &up) == OK && api->get(c, of, UNKNOWNS, more) == OK);
        EXPECT(api->set(c, &from[k], 1, &down) == OK && api->get(c, of, UNKNOWNS, less) == OK);
        EXPECT(api->set(c, &from[k], 1, &here) == OK);
        for (int u = 0; u < UNKNOWNS; u += 1) largest = fmax(largest, fabs(exact[u]));
        EXPECT(largest > 0.0);
        for (int u = 0; u < UNKNOWNS; u += 1) {
            double difference = (more[u] - less[u]) / (up - down);
            int close = fabs(difference - exact[u]) <= 1e-3 * fabs(exact[u]) + 1e-5 * largest;
            if (!close) fprintf(stderr, "d %s / d %s: %g, by differences %g\n", unknowns[u], knowns[k], exact[u], difference);
            expect(close, unknowns[u], knowns[k], u);
        }
    }
    /* Lists that cannot be. */
    const uint32_t nobody = NOBODY, mass = reference("wedge_mass");
    double one = 1.0, out = 0.0;
    REFUSED(api->along(c, &nobody, 1, from, 1, &one, &out));
    REFUSED(api->along(c, of, 1, &nobody, 1, &one, &out));
    REFUSED(api->along(c, from, 1, from, 1, &one, &out));
    REFUSED(api->along(c, of, 1, of, 1, &one, &out));
    REFUSED(api->along(c, of, 1, &mass, 1, &one, &out));
    REFUSED(api->along(c, NULL, 1, from, 1, &one, &out));
    REFUSED(api->along(c, of, 1, NULL, 1, &one, &out));
    REFUSED(api->along(c, of, 1, from, 1, NULL, &out));
    REFUSED(api->along(c, of, 1, from, 1, &one, NULL));
    EXPECT(api->along(c, NULL, 0, NULL, 0, NULL, NULL) == OK);
    /* States: wrong numbers, null pointers, what is not finite; and the same rates through both doors. */
    double *x = room(state_count * sizeof *x), *rates = room(state_count * sizeof *rates);
    EXPECT(api->states(c, x, state_count) == OK);
    EXPECT(api->rates(c, rates, state_count) == OK);
    const uint32_t rate = reference("der(wedge_z)"), speed = reference("wedge_z_rate");
    EXPECT(api->get(c, &rate, 1, &out) == OK && api->get(c, &speed, 1, &one) == OK && out == one);
    REFUSED(api->states(c, x, state_count - 1));
    REFUSED(api->states(c, NULL, state_count));
    REFUSED(api->rates(c, rates, state_count + 1));
    REFUSED(api->rates(c, NULL, state_count));
    REFUSED(api->nominals(c, rates, 0));
    REFUSED(api->indicators(c, rates, 1));
    REFUSED(api->set_states(c, x, 1));
    REFUSED(api->set_states(c, NULL, state_count));
    REFUSED(api->set_time(c, NAN));
    x[0] = NAN;
    REFUSED(api->set_states(c, x, state_count));
    double *again = room(state_count * sizeof *again);
    EXPECT(api->rates(c, again, state_count) == OK && memcmp(rates, again, state_count * sizeof *rates) == 0);
    free(x), free(rates), free(again);
    api->free_instance(c);
}

/* Three instances of co-simulation and one of model exchange, one after the other and in turns. */
void check_instances(void) {
    double alone[3][6], together[3][6];
    void *c[3];
    for (int i = 0; i < 3; i += 1) {
        void *one = started(0);
        drive(one, 0, 30, 0.02 * (i + 1), alone[i]);
        api->free_instance(one);
    }
    void *other = started(1);
    for (int i = 0; i < 3; i += 1) c[i] = started(0);
    for (int k = 0; k < 30; k += 1) {
        for (int i = 0; i < 3; i += 1) drive(c[i], k, k + 1, 0.02 * (i + 1), together[i]);
        if (k == 10) api->free_instance(other);
    }
    EXPECT(memcmp(alone, together, sizeof alone) == 0);
    EXPECT(memcmp(alone[0], alone[1], sizeof alone[0]) != 0);
    for (int i = 0; i < 3; i += 1) api->free_instance(c[(i + 1) % 3]);
}
