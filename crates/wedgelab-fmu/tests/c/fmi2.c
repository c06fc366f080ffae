/* FMI 2.0: every function of the standard's header, by its name and with its type. */
#include "check.h"

#include "fmi2TypesPlatform.h"
#include "fmi2FunctionTypes.h"

#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* X(name) for every function that fmi2Functions.h declares; made from that header. */
#include "fmi2_list.h"

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

static void logger(fmi2ComponentEnvironment given, fmi2String name, fmi2Status status, fmi2String category, fmi2String format, ...) {
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    EXPECT(given == &environment && name && category && strlen(text) > 10);
    EXPECT(status <= fmi2Error);
    messages += 1;
}

static const fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, &environment};

static void *instantiate(int exchange, const char *name, const char *guid, const char *folder) {
    return CALL(fmi2Instantiate, name, exchange ? fmi2ModelExchange : fmi2CoSimulation, guid, folder, &callbacks, fmi2False,
                fmi2True);
}
static void free_instance(void *c) { CALL(fmi2FreeInstance, c); }
static int enter(void *c) { return CALL(fmi2EnterInitializationMode, c); }
static int leave(void *c) { return CALL(fmi2ExitInitializationMode, c); }
static int terminate(void *c) { return CALL(fmi2Terminate, c); }
static int reset(void *c) { return CALL(fmi2Reset, c); }
static int get(void *c, const uint32_t *vr, size_t n, double *v) { return CALL(fmi2GetReal, c, vr, n, v); }
static int set(void *c, const uint32_t *vr, size_t n, const double *v) { return CALL(fmi2SetReal, c, vr, n, v); }
static int get_integer(void *c, const uint32_t *vr, size_t n, int32_t *v) { return CALL(fmi2GetInteger, c, vr, n, v); }
static int set_integer(void *c, const uint32_t *vr, size_t n, const int32_t *v) { return CALL(fmi2SetInteger, c, vr, n, v); }
static int get_boolean(void *c, const uint32_t *vr, size_t n, int *v) { return CALL(fmi2GetBoolean, c, vr, n, v); }
static int set_boolean(void *c, const uint32_t *vr, size_t n, const int *v) { return CALL(fmi2SetBoolean, c, vr, n, v); }
static int step(void *c, double time, double length) { return CALL(fmi2DoStep, c, time, length, fmi2False); }
static int save(void *c, void **state) { return CALL(fmi2GetFMUstate, c, state); }
static int restore(void *c, void *state) { return CALL(fmi2SetFMUstate, c, state); }
static int free_state(void *c, void **state) { return CALL(fmi2FreeFMUstate, c, state); }
static int size(void *c, void *state, size_t *n) { return CALL(fmi2SerializedFMUstateSize, c, state, n); }
static int serialize(void *c, void *state, char *to, size_t n) { return CALL(fmi2SerializeFMUstate, c, state, to, n); }
static int deserialize(void *c, const char *from, size_t n, void **state) {
    return CALL(fmi2DeSerializeFMUstate, c, from, n, state);
}
static int along(void *c, const uint32_t *of, size_t n, const uint32_t *by, size_t m, const double *seed, double *out) {
    return CALL(fmi2GetDirectionalDerivative, c, of, n, by, m, seed, out);
}
static int event_mode(void *c) { return CALL(fmi2EnterEventMode, c); }
static int discrete_states(void *c) {
    fmi2EventInfo info;
    memset(&info, 0x5a, sizeof info);
    int status = CALL(fmi2NewDiscreteStates, c, &info);
    if (status == OK) {
        EXPECT(info.newDiscreteStatesNeeded == fmi2False && info.terminateSimulation == fmi2False);
        EXPECT(info.valuesOfContinuousStatesChanged == fmi2False && info.nextEventTimeDefined == fmi2False);
        EXPECT(info.nominalsOfContinuousStatesChanged == fmi2False && info.nextEventTime == 0.0);
    }
    return status;
}
static int continuous_mode(void *c) { return CALL(fmi2EnterContinuousTimeMode, c); }
static int completed_step(void *c) {
    fmi2Boolean event = 77, end = 77;
    int status = CALL(fmi2CompletedIntegratorStep, c, fmi2True, &event, &end);
    EXPECT(status != OK || (event == fmi2False && end == fmi2False));
    return status;
}
static int set_time(void *c, double time) { return CALL(fmi2SetTime, c, time); }
static int set_states(void *c, const double *x, size_t n) { return CALL(fmi2SetContinuousStates, c, x, n); }
static int rates(void *c, double *x, size_t n) { return CALL(fmi2GetDerivatives, c, x, n); }
static int indicators(void *c, double *x, size_t n) { return CALL(fmi2GetEventIndicators, c, x, n); }
static int states(void *c, double *x, size_t n) { return CALL(fmi2GetContinuousStates, c, x, n); }
static int nominals(void *c, double *x, size_t n) { return CALL(fmi2GetNominalsOfContinuousStates, c, x, n); }

static void others(void) {
    EXPECT(strcmp(CALL(fmi2GetTypesPlatform), "default") == 0);
    EXPECT(strcmp(CALL(fmi2GetVersion), "2.0") == 0);
    /* Another kind of FMU; callbacks without a logger, or none at all. */
    EXPECT(CALL(fmi2Instantiate, "wedge", (fmi2Type)7, token, resources, &callbacks, fmi2False, fmi2True) == NULL);
    EXPECT(CALL(fmi2Instantiate, "wedge", fmi2CoSimulation, "wrong", resources, NULL, fmi2False, fmi2True) == NULL);
    const fmi2CallbackFunctions silent = {NULL, NULL, NULL, NULL, NULL};
    void *c = CALL(fmi2Instantiate, "wedge", fmi2CoSimulation, token, resources, &silent, fmi2True, fmi2True);
    EXPECT(c != NULL && step(c, 0.0, 1e-3) == ERROR);
    free_instance(c);
    c = CALL(fmi2Instantiate, "wedge", fmi2CoSimulation, token, resources, NULL, fmi2True, fmi2True);
    EXPECT(c != NULL && step(c, 0.0, 1e-3) == ERROR);
    free_instance(c);

    c = made(0);
    EXPECT(CALL(fmi2SetupExperiment, NULL, fmi2False, 0.0, 0.0, fmi2False, 0.0) == ERROR);
    REFUSED(CALL(fmi2SetupExperiment, c, fmi2False, 0.0, NAN, fmi2False, 0.0));
    REFUSED(CALL(fmi2SetupExperiment, c, fmi2False, 0.0, 1.0, fmi2True, 0.5));
    REFUSED(CALL(fmi2SetupExperiment, c, fmi2False, 0.0, 1.0, fmi2True, NAN));
    REFUSED(CALL(fmi2SetupExperiment, c, fmi2True, -1.0, 0.0, fmi2False, 0.0));
    REFUSED(CALL(fmi2SetupExperiment, c, fmi2True, NAN, 0.0, fmi2False, 0.0));
    EXPECT(CALL(fmi2SetupExperiment, c, fmi2True, 1e-6, 2.0, fmi2True, 2.01) == OK);

    /* The log: of some categories, of all, of one that is none. */
    const fmi2String some[2] = {"logEvents", "logStatusWarning"}, none[1] = {"logWeather"}, null[1] = {NULL};
    EXPECT(CALL(fmi2SetDebugLogging, NULL, fmi2True, 0, NULL) == ERROR);
    EXPECT(CALL(fmi2SetDebugLogging, c, fmi2True, 2, some) == OK);
    EXPECT(CALL(fmi2SetDebugLogging, c, fmi2False, 2, some) == OK);
    REFUSED(CALL(fmi2SetDebugLogging, c, fmi2True, 1, none));
    REFUSED(CALL(fmi2SetDebugLogging, c, fmi2True, 1, null));
    REFUSED(CALL(fmi2SetDebugLogging, c, fmi2True, 1, NULL));
    EXPECT(CALL(fmi2SetDebugLogging, c, fmi2False, 0, NULL) == OK);
    EXPECT(CALL(fmi2SetDebugLogging, c, fmi2True, 0, NULL) == OK);

    EXPECT(enter(c) == OK && leave(c) == OK);
    REFUSED(CALL(fmi2SetupExperiment, c, fmi2False, 0.0, 0.0, fmi2False, 0.0));
    REFUSED(step(c, 0.0, 1e-3));
    EXPECT(step(c, 2.0, 5e-3) == OK);
    REFUSED(step(c, 2.005, 6e-3));
    EXPECT(step(c, 2.005, 5e-3) == OK);

    /* Derivatives of inputs and of outputs. */
    const fmi2ValueReference input = reference("bolster_z_rate"), output = reference("force_on_bolster_z"), nobody = NOBODY;
    const fmi2Integer orders[3] = {1, 2, 0};
    const fmi2Real slope = 0.1, bad = NAN;
    fmi2Real value = 0.0;
    EXPECT(CALL(fmi2SetRealInputDerivatives, NULL, &input, 1, orders, &slope) == ERROR);
    EXPECT(CALL(fmi2SetRealInputDerivatives, c, &input, 1, orders, &slope) == OK);
    EXPECT(CALL(fmi2SetRealInputDerivatives, c, NULL, 0, NULL, NULL) == OK);
    REFUSED(CALL(fmi2SetRealInputDerivatives, c, &input, 1, orders + 1, &slope));
    REFUSED(CALL(fmi2SetRealInputDerivatives, c, &input, 1, orders + 2, &slope));
    REFUSED(CALL(fmi2SetRealInputDerivatives, c, &input, 1, orders, &bad));
    REFUSED(CALL(fmi2SetRealInputDerivatives, c, &output, 1, orders, &slope));
    REFUSED(CALL(fmi2SetRealInputDerivatives, c, &nobody, 1, orders, &slope));
    REFUSED(CALL(fmi2SetRealInputDerivatives, c, NULL, 1, orders, &slope));
    REFUSED(CALL(fmi2SetRealInputDerivatives, c, &input, 1, NULL, &slope));
    REFUSED(CALL(fmi2SetRealInputDerivatives, c, &input, 1, orders, NULL));
    EXPECT(CALL(fmi2GetRealOutputDerivatives, NULL, &output, 1, orders, &value) == ERROR);
    EXPECT(CALL(fmi2GetRealOutputDerivatives, c, NULL, 0, NULL, NULL) == OK);
    REFUSED(CALL(fmi2GetRealOutputDerivatives, c, &output, 1, orders, &value));

    /* Strings: there are none. */
    fmi2String text = NULL;
    EXPECT(CALL(fmi2GetString, NULL, &input, 1, &text) == ERROR && CALL(fmi2SetString, NULL, &input, 1, &text) == ERROR);
    EXPECT(CALL(fmi2GetString, c, NULL, 0, NULL) == OK && CALL(fmi2SetString, c, NULL, 0, NULL) == OK);
    REFUSED(CALL(fmi2GetString, c, &input, 1, &text));
    REFUSED(CALL(fmi2SetString, c, &input, 1, &text));
    REFUSED(CALL(fmi2GetString, c, NULL, 1, NULL));

    /* Status of a step: none is ever under way. */
    fmi2Status status = fmi2OK;
    fmi2Integer integer = 0;
    fmi2Boolean truth = 77;
    EXPECT(CALL(fmi2CancelStep, NULL) == ERROR && CALL(fmi2GetStatus, NULL, fmi2DoStepStatus, &status) == ERROR);
    EXPECT(CALL(fmi2GetRealStatus, NULL, fmi2LastSuccessfulTime, &value) == ERROR);
    EXPECT(CALL(fmi2GetIntegerStatus, NULL, fmi2DoStepStatus, &integer) == ERROR);
    EXPECT(CALL(fmi2GetBooleanStatus, NULL, fmi2Terminated, &truth) == ERROR);
    EXPECT(CALL(fmi2GetStringStatus, NULL, fmi2PendingStatus, &text) == ERROR);
    REFUSED(CALL(fmi2CancelStep, c));
    DISCARDED(CALL(fmi2GetStatus, c, fmi2DoStepStatus, &status));
    DISCARDED(CALL(fmi2GetIntegerStatus, c, fmi2DoStepStatus, &integer));
    DISCARDED(CALL(fmi2GetStringStatus, c, fmi2PendingStatus, &text));
    DISCARDED(CALL(fmi2GetRealStatus, c, fmi2DoStepStatus, &value));
    EXPECT(CALL(fmi2GetRealStatus, c, fmi2LastSuccessfulTime, &value) == OK && fabs(value - 2.01) < 1e-9);
    REFUSED(CALL(fmi2GetRealStatus, c, fmi2LastSuccessfulTime, NULL));
    EXPECT(CALL(fmi2GetBooleanStatus, c, fmi2Terminated, &truth) == OK && truth == fmi2False);
    DISCARDED(CALL(fmi2GetBooleanStatus, c, fmi2DoStepStatus, &truth));
    REFUSED(CALL(fmi2GetBooleanStatus, c, fmi2Terminated, NULL));
    EXPECT(terminate(c) == OK);
    free_instance(c);

    /* Null where model exchange writes to. */
    c = started(1);
    REFUSED(CALL(fmi2NewDiscreteStates, c, NULL));
    EXPECT(continuous_mode(c) == OK);
    REFUSED(CALL(fmi2CompletedIntegratorStep, c, fmi2True, NULL, &truth));
    REFUSED(CALL(fmi2CompletedIntegratorStep, c, fmi2True, &truth, NULL));
    free_instance(c);
}

static const Api calls = {
    2,        instantiate, free_instance, enter,           leave,           terminate,      reset,    get,        set,    get_integer,
    set_integer, get_boolean, set_boolean, step,           save,            restore,        free_state, size,     serialize, deserialize,
    along,    event_mode,  discrete_states, continuous_mode, completed_step, set_time,       set_states, rates,    indicators, states,
    nominals, others,      uncalled,
};

const Api *load_fmi2(void *library) {
#define X(name)                                                                                                        \
    *(void **)&fn.name = dlsym(library, #name);                                                                        \
    if (!fn.name) fprintf(stderr, "the library has no %s\n", #name), exit(2);
    FUNCTIONS
#undef X
    return &calls;
}
