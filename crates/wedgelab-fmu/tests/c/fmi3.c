/* FMI 3.0: every function of the standard's header, by its name and with its type. */
#include "check.h"

#include "fmi3PlatformTypes.h"
#include "fmi3FunctionTypes.h"

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* X(name) for every function that fmi3Functions.h declares; made from that header. */
#include "fmi3_list.h"

static struct {
#define X(name) name##TYPE *name;
    FUNCTIONS
#undef X
} fn;
static struct {
#define X(name) char name;
    FUNCTIONS
#undef X
} called;
#define CALL(name, ...) (called.name = 1, fn.name(__VA_ARGS__))

static void uncalled(void) {
#define X(name) expect(called.name, "called: " #name, __FILE__, __LINE__);
    FUNCTIONS
#undef X
}

static int environment;

static void logger(fmi3InstanceEnvironment given, fmi3Status status, fmi3String category, fmi3String text) {
    EXPECT(given == &environment && category && strlen(text) > 10);
    EXPECT(status <= fmi3Error);
    messages += 1;
}

static void *instantiate(int exchange, const char *name, const char *given, const char *folder) {
    return exchange ? CALL(fmi3InstantiateModelExchange, name, given, folder, false, true, &environment, logger)
                    : CALL(fmi3InstantiateCoSimulation, name, given, folder, false, true, false, false, NULL, 0, &environment, logger,
                           NULL);
}
static void free_instance(void *c) { CALL(fmi3FreeInstance, c); }
static int enter(void *c) { return CALL(fmi3EnterInitializationMode, c, false, 0.0, 0.0, false, 0.0); }
static int leave(void *c) { return CALL(fmi3ExitInitializationMode, c); }
static int terminate(void *c) { return CALL(fmi3Terminate, c); }
static int reset(void *c) { return CALL(fmi3Reset, c); }
static int get(void *c, const uint32_t *vr, size_t n, double *v) { return CALL(fmi3GetFloat64, c, vr, n, v, n); }
static int set(void *c, const uint32_t *vr, size_t n, const double *v) { return CALL(fmi3SetFloat64, c, vr, n, v, n); }
static int get_integer(void *c, const uint32_t *vr, size_t n, int32_t *v) { return CALL(fmi3GetInt32, c, vr, n, v, n); }
static int set_integer(void *c, const uint32_t *vr, size_t n, const int32_t *v) { return CALL(fmi3SetInt32, c, vr, n, v, n); }
/* One Boolean value at most: those of C and of this program differ in size. */
static int get_boolean(void *c, const uint32_t *vr, size_t n, int *v) {
    bool value = false;
    int status = CALL(fmi3GetBoolean, c, vr, n, &value, n);
    if (v) *v = value;
    return status;
}
static int set_boolean(void *c, const uint32_t *vr, size_t n, const int *v) {
    bool value = v && *v;
    return CALL(fmi3SetBoolean, c, vr, n, &value, n);
}
static int step(void *c, double time, double length) {
    bool events = true, end = true, early = true;
    double reached = NAN;
    int status = CALL(fmi3DoStep, c, time, length, true, &events, &end, &early, &reached);
    EXPECT(status != OK || (!events && !end && !early && fabs(reached - time - length) < 1e-12));
    return status;
}
static int save(void *c, void **state) { return CALL(fmi3GetFMUState, c, state); }
static int restore(void *c, void *state) { return CALL(fmi3SetFMUState, c, state); }
static int free_state(void *c, void **state) { return CALL(fmi3FreeFMUState, c, state); }
static int size(void *c, void *state, size_t *n) { return CALL(fmi3SerializedFMUStateSize, c, state, n); }
static int serialize(void *c, void *state, char *to, size_t n) { return CALL(fmi3SerializeFMUState, c, state, (fmi3Byte *)to, n); }
static int deserialize(void *c, const char *from, size_t n, void **state) {
    return CALL(fmi3DeserializeFMUState, c, (const fmi3Byte *)from, n, state);
}
static int along(void *c, const uint32_t *of, size_t n, const uint32_t *by, size_t m, const double *seed, double *out) {
    return CALL(fmi3GetDirectionalDerivative, c, of, n, by, m, seed, m, out, n);
}
static int event_mode(void *c) { return CALL(fmi3EnterEventMode, c); }
static int discrete_states(void *c) {
    bool again = true, end = true, nominals = true, values = true, event = true;
    double next = NAN;
    int status = CALL(fmi3UpdateDiscreteStates, c, &again, &end, &nominals, &values, &event, &next);
    EXPECT(status != OK || (!again && !end && !nominals && !values && !event));
    return status;
}
static int continuous_mode(void *c) { return CALL(fmi3EnterContinuousTimeMode, c); }
static int completed_step(void *c) {
    bool event = true, end = true;
    int status = CALL(fmi3CompletedIntegratorStep, c, true, &event, &end);
    EXPECT(status != OK || (!event && !end));
    return status;
}
static int set_time(void *c, double time) { return CALL(fmi3SetTime, c, time); }
static int set_states(void *c, const double *x, size_t n) { return CALL(fmi3SetContinuousStates, c, x, n); }
static int rates(void *c, double *x, size_t n) { return CALL(fmi3GetContinuousStateDerivatives, c, x, n); }
static int indicators(void *c, double *x, size_t n) { return CALL(fmi3GetEventIndicators, c, x, n); }
static int states(void *c, double *x, size_t n) { return CALL(fmi3GetContinuousStates, c, x, n); }
static int nominals(void *c, double *x, size_t n) { return CALL(fmi3GetNominalsOfContinuousStates, c, x, n); }

/* Types that no variable has: nothing can be got or set, and nothing is no error. */
#define STRANGE(type, values)                                                                                          \
    do {                                                                                                               \
        EXPECT(CALL(fmi3Get##type, NULL, &vr, 1, values, 1) == ERROR && CALL(fmi3Set##type, NULL, &vr, 1, values, 1) == ERROR); \
        EXPECT(CALL(fmi3Get##type, c, NULL, 0, NULL, 0) == OK && CALL(fmi3Set##type, c, NULL, 0, NULL, 0) == OK);      \
        REFUSED(CALL(fmi3Get##type, c, &vr, 1, values, 1));                                                            \
        REFUSED(CALL(fmi3Set##type, c, &vr, 1, values, 1));                                                            \
        REFUSED(CALL(fmi3Get##type, c, NULL, 1, NULL, 1));                                                             \
    } while (0)

static void strange(void *c) {
    const fmi3ValueReference vr = reference("bolster_z");
    uint64_t number = 0;
    void *values = &number;
    fmi3String text = "";
    fmi3Binary binary = NULL;
    size_t sizes = 0;
    fmi3Clock clock = false;
    fmi3IntervalQualifier qualifier;
    uint64_t counters = 1, resolutions = 1;
    double time = 0.0;
    STRANGE(Float32, values);
    STRANGE(Int8, values);
    STRANGE(UInt8, values);
    STRANGE(Int16, values);
    STRANGE(UInt16, values);
    STRANGE(UInt32, values);
    STRANGE(Int64, values);
    STRANGE(UInt64, values);
    STRANGE(String, &text);
    EXPECT(CALL(fmi3GetBinary, NULL, &vr, 1, &sizes, &binary, 1) == ERROR);
    EXPECT(CALL(fmi3GetBinary, c, NULL, 0, NULL, NULL, 0) == OK && CALL(fmi3SetBinary, c, NULL, 0, NULL, NULL, 0) == OK);
    REFUSED(CALL(fmi3GetBinary, c, &vr, 1, &sizes, &binary, 1));
    REFUSED(CALL(fmi3SetBinary, c, &vr, 1, &sizes, &binary, 1));
    EXPECT(CALL(fmi3GetClock, NULL, &vr, 1, &clock) == ERROR && CALL(fmi3SetClock, NULL, &vr, 1, &clock) == ERROR);
    REFUSED(CALL(fmi3GetClock, c, &vr, 1, &clock));
    REFUSED(CALL(fmi3SetClock, c, &vr, 1, &clock));
    REFUSED(CALL(fmi3GetIntervalDecimal, c, &vr, 1, &time, &qualifier));
    REFUSED(CALL(fmi3SetIntervalDecimal, c, &vr, 1, &time));
    REFUSED(CALL(fmi3GetIntervalFraction, c, &vr, 1, &counters, &resolutions, &qualifier));
    REFUSED(CALL(fmi3SetIntervalFraction, c, &vr, 1, &counters, &resolutions));
    REFUSED(CALL(fmi3GetShiftDecimal, c, &vr, 1, &time));
    REFUSED(CALL(fmi3SetShiftDecimal, c, &vr, 1, &time));
    REFUSED(CALL(fmi3GetShiftFraction, c, &vr, 1, &counters, &resolutions));
    REFUSED(CALL(fmi3SetShiftFraction, c, &vr, 1, &counters, &resolutions));
    EXPECT(CALL(fmi3GetShiftFraction, NULL, &vr, 1, &counters, &resolutions) == ERROR);
}

/* Functions for what the model does not have. */
static void unused(void *c) {
    const fmi3ValueReference vr = reference("bolster_z"), output = reference("force_on_bolster_z");
    size_t count = 0, elements = 0, independent_elements = 0;
    fmi3ValueReference independents = 0;
    fmi3DependencyKind kinds;
    const fmi3Int32 order = 1;
    double value = 0.0, seed = 1.0;
    EXPECT(CALL(fmi3GetNumberOfVariableDependencies, NULL, vr, &count) == ERROR);
    REFUSED(CALL(fmi3GetNumberOfVariableDependencies, c, vr, &count));
    REFUSED(CALL(fmi3GetVariableDependencies, c, vr, &elements, &independents, &independent_elements, &kinds, 1));
    REFUSED(CALL(fmi3GetAdjointDerivative, c, &output, 1, &vr, 1, &seed, 1, &value, 1));
    REFUSED(CALL(fmi3EnterConfigurationMode, c));
    REFUSED(CALL(fmi3ExitConfigurationMode, c));
    REFUSED(CALL(fmi3EnterStepMode, c));
    EXPECT(CALL(fmi3GetOutputDerivatives, c, NULL, 0, NULL, NULL, 0) == OK);
    REFUSED(CALL(fmi3GetOutputDerivatives, c, &output, 1, &order, &value, 1));
    REFUSED(CALL(fmi3ActivateModelPartition, c, vr, 0.0));
    EXPECT(CALL(fmi3EvaluateDiscreteStates, NULL) == ERROR);
    EXPECT(CALL(fmi3InstantiateScheduledExecution, "wedge", token, resources, false, true, &environment, logger, NULL, NULL, NULL) ==
           NULL);
    EXPECT(CALL(fmi3InstantiateScheduledExecution, NULL, NULL, NULL, false, true, NULL, NULL, NULL, NULL, NULL) == NULL);
    EXPECT(CALL(fmi3InstantiateCoSimulation, "wedge", token, resources, false, true, true, false, NULL, 0, &environment, logger,
                NULL) == NULL);
    EXPECT(CALL(fmi3InstantiateCoSimulation, "wedge", token, resources, false, true, false, false, &vr, 1, &environment, logger,
                NULL) == NULL);
}

static void others(void) {
    EXPECT(strcmp(CALL(fmi3GetVersion), "3.0") == 0);
    /* No logger at all. */
    void *c = CALL(fmi3InstantiateCoSimulation, "wedge", token, resources, true, true, false, true, NULL, 0, NULL, NULL, NULL);
    EXPECT(c != NULL && step(c, 0.0, 1e-3) == ERROR);
    free_instance(c);
    EXPECT(CALL(fmi3InstantiateModelExchange, "wedge", "wrong", resources, true, true, NULL, NULL) == NULL);

    c = made(0);
    const fmi3String some[2] = {"logEvents", "logStatusWarning"}, none[1] = {"logWeather"}, null[1] = {NULL};
    EXPECT(CALL(fmi3SetDebugLogging, NULL, true, 0, NULL) == ERROR);
    EXPECT(CALL(fmi3SetDebugLogging, c, true, 2, some) == OK && CALL(fmi3SetDebugLogging, c, false, 2, some) == OK);
    REFUSED(CALL(fmi3SetDebugLogging, c, true, 1, none));
    REFUSED(CALL(fmi3SetDebugLogging, c, true, 1, null));
    REFUSED(CALL(fmi3SetDebugLogging, c, true, 1, NULL));
    EXPECT(CALL(fmi3SetDebugLogging, c, false, 0, NULL) == OK && CALL(fmi3SetDebugLogging, c, true, 0, NULL) == OK);
    REFUSED(CALL(fmi3EnterInitializationMode, c, true, -1.0, 0.0, false, 0.0));
    REFUSED(CALL(fmi3EnterInitializationMode, c, true, NAN, 0.0, false, 0.0));
    REFUSED(CALL(fmi3EnterInitializationMode, c, false, 0.0, NAN, false, 0.0));
    REFUSED(CALL(fmi3EnterInitializationMode, c, false, 0.0, 1.0, true, 0.0));
    EXPECT(CALL(fmi3EnterInitializationMode, c, true, 1e-6, 2.0, true, 2.01) == OK);
    EXPECT(leave(c) == OK);
    REFUSED(step(c, 0.0, 1e-3));
    EXPECT(step(c, 2.0, 5e-3) == OK);
    REFUSED(step(c, 2.005, 6e-3));

    /* Null where a step writes to: refused before anything is done. */
    bool a = false, b = false, d = false;
    double reached = 0.0;
    REFUSED(CALL(fmi3DoStep, c, 2.005, 1e-3, true, NULL, &a, &b, &reached));
    REFUSED(CALL(fmi3DoStep, c, 2.005, 1e-3, true, &a, NULL, &b, &reached));
    REFUSED(CALL(fmi3DoStep, c, 2.005, 1e-3, true, &a, &b, NULL, &reached));
    REFUSED(CALL(fmi3DoStep, c, 2.005, 1e-3, true, &a, &b, &d, NULL));
    EXPECT(step(c, 2.005, 5e-3) == OK);

    /* As many values as references. */
    const fmi3ValueReference input = reference("bolster_z"), mode = reference("column_lower_right_state"),
                             option = reference("derive_rates"), output = reference("force_on_bolster_z");
    double value = 0.0, seed = 1.0;
    fmi3Int32 integer = 0;
    REFUSED(CALL(fmi3GetFloat64, c, &input, 1, &value, 0));
    REFUSED(CALL(fmi3SetFloat64, c, &input, 1, &value, 0));
    REFUSED(CALL(fmi3GetInt32, c, &mode, 1, &integer, 0));
    REFUSED(CALL(fmi3SetInt32, c, &mode, 0, &integer, 1));
    REFUSED(CALL(fmi3GetBoolean, c, &option, 1, &a, 0));
    REFUSED(CALL(fmi3SetBoolean, c, &option, 0, &a, 1));
    REFUSED(CALL(fmi3GetBoolean, c, &option, 1, NULL, 1));
    REFUSED(CALL(fmi3GetDirectionalDerivative, c, &output, 1, &input, 1, &seed, 0, &value, 1));
    REFUSED(CALL(fmi3GetDirectionalDerivative, c, &output, 1, &input, 1, &seed, 1, &value, 0));
    strange(c);
    unused(c);
    EXPECT(terminate(c) == OK);
    free_instance(c);

    c = started(1);
    size_t count = 0;
    EXPECT(CALL(fmi3GetNumberOfContinuousStates, NULL, &count) == ERROR && CALL(fmi3GetNumberOfEventIndicators, NULL, &count) == ERROR);
    EXPECT(CALL(fmi3GetNumberOfContinuousStates, c, &count) == OK && count == state_count);
    EXPECT(CALL(fmi3GetNumberOfEventIndicators, c, &count) == OK && count == indicator_count);
    REFUSED(CALL(fmi3GetNumberOfContinuousStates, c, NULL));
    REFUSED(CALL(fmi3GetNumberOfEventIndicators, c, NULL));
    EXPECT(CALL(fmi3EvaluateDiscreteStates, c) == OK);
    REFUSED(CALL(fmi3UpdateDiscreteStates, c, NULL, &a, &a, &a, &a, &value));
    REFUSED(CALL(fmi3UpdateDiscreteStates, c, &a, &a, &a, &a, &a, NULL));
    EXPECT(continuous_mode(c) == OK);
    REFUSED(CALL(fmi3CompletedIntegratorStep, c, true, NULL, &a));
    REFUSED(CALL(fmi3CompletedIntegratorStep, c, true, &a, NULL));
    free_instance(c);
}

static const Api calls = {
    3,        instantiate, free_instance, enter,           leave,           terminate,      reset,    get,        set,    get_integer,
    set_integer, get_boolean, set_boolean, step,           save,            restore,        free_state, size,     serialize, deserialize,
    along,    event_mode,  discrete_states, continuous_mode, completed_step, set_time,       set_states, rates,    indicators, states,
    nominals, others,      uncalled,
};

const Api *load_fmi3(void *library) {
#define X(name)                                                                                                        \
    *(void **)&fn.name = dlsym(library, #name);                                                                        \
    if (!fn.name) fprintf(stderr, "the library has no %s\n", #name), exit(2);
    FUNCTIONS
#undef X
    return &calls;
}
