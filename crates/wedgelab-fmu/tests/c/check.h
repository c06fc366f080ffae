/* What all parts of the program share: expectations, the log of instances, and one set of calls for both versions of the standard. */
#ifndef CHECK_H
#define CHECK_H

#include <stddef.h>
#include <stdint.h>

/* Status codes, the same in both versions: of no type of their own, to be compared with those of both. */
#define OK 0
#define DISCARD 2
#define ERROR 3

/* How many messages instances have logged so far. */
extern long messages;
/* How many expectations were not met. */
extern long failures;
/* How many were looked at. */
extern long expectations;

/* Notes whether something is as expected; says where if it is not. */
void expect(int holds, const char *what, const char *file, int line);
#define EXPECT(condition) expect((condition) != 0, #condition, __FILE__, __LINE__)

/* A call that must be refused, with a message in the log. */
#define REFUSED(call)                                                                                                  \
    do {                                                                                                               \
        long before_ = messages;                                                                                       \
        int status_ = (int)(call);                                                                                     \
        expect(status_ == ERROR, "an error: " #call, __FILE__, __LINE__);                                              \
        expect(messages > before_, "a message: " #call, __FILE__, __LINE__);                                           \
    } while (0)

/* A question without an answer, which the log tells too. */
#define DISCARDED(call)                                                                                                \
    do {                                                                                                               \
        long before_ = messages;                                                                                       \
        int status_ = (int)(call);                                                                                     \
        expect(status_ == DISCARD, "discarded: " #call, __FILE__, __LINE__);                                           \
        expect(messages > before_, "a message: " #call, __FILE__, __LINE__);                                           \
    } while (0)

/* The value reference of a variable. */
uint32_t reference(const char *name);
/* One that no variable has. */
enum { NOBODY = 1000000 };

/* Memory of exactly this size, so that reading or writing past its end is found. */
void *room(size_t bytes);

/* Calls of one version; Boolean values are int here. */
typedef struct {
    int version;
    void *(*instantiate)(int exchange, const char *name, const char *token, const char *resources);
    void (*free_instance)(void *);
    int (*enter_initialization)(void *);
    int (*exit_initialization)(void *);
    int (*terminate)(void *);
    int (*reset)(void *);
    int (*get)(void *, const uint32_t *, size_t, double *);
    int (*set)(void *, const uint32_t *, size_t, const double *);
    int (*get_integer)(void *, const uint32_t *, size_t, int32_t *);
    int (*set_integer)(void *, const uint32_t *, size_t, const int32_t *);
    int (*get_boolean)(void *, const uint32_t *, size_t, int *);
    int (*set_boolean)(void *, const uint32_t *, size_t, const int *);
    int (*step)(void *, double time, double length);
    int (*save)(void *, void **);
    int (*restore)(void *, void *);
    int (*free_state)(void *, void **);
    int (*size)(void *, void *, size_t *);
    int (*serialize)(void *, void *, char *, size_t);
    int (*deserialize)(void *, const char *, size_t, void **);
    int (*along)(void *, const uint32_t *unknowns, size_t, const uint32_t *knowns, size_t, const double *seed, double *);
    int (*event_mode)(void *);
    int (*discrete_states)(void *);
    int (*continuous_mode)(void *);
    int (*completed_step)(void *);
    int (*set_time)(void *, double);
    int (*set_states)(void *, const double *, size_t);
    int (*rates)(void *, double *, size_t);
    int (*indicators)(void *, double *, size_t);
    int (*states)(void *, double *, size_t);
    int (*nominals)(void *, double *, size_t);
    /* What only this version has, in and out of order. */
    void (*others)(void);
    /* Every function that has not been called. */
    void (*uncalled)(void);
} Api;

extern const Api *api;
/* What an instance is made from. */
extern const char *token, *resources;
/* How many states and event indicators the model has. */
extern size_t state_count, indicator_count;

/* Takes every function of a version from a library by its name; they must all be there. */
const Api *load_fmi2(void *library);
const Api *load_fmi3(void *library);

/* An instance that must be made. */
void *made(int exchange);
/* The same, after the initialization. */
void *started(int exchange);
/* Makes steps of 1 ms of co-simulation, the bolster moving up and down; the last outputs go to `out` (6 values). */
void drive(void *instance, int first, int last, double amplitude, double *out);

/* Parts of the program. */
void check_nobody(void);
void check_instantiation(void);
void check_phases(int exchange);
void check_values(void);
void check_steps(void);
void check_states(int corruptions);
void check_derivatives(void);
void check_instances(void);

#endif
