/* The equations of the race, compiled; see benchmarks/race/src/c_interface.rs. SI units.
 *
 * State: positions, speeds, bristle deflections, energy lost in friction at the first face. Functions that return
 * int give 0 when all is well. A handle is used by one thread at a time. */
#ifndef RACE_H
#define RACE_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct race_problem race_problem;

/* A problem by its name; NULL if there is none. */
race_problem *race_open(const char *name);
void race_close(race_problem *problem);
/* Number of states. */
int race_dimension(const race_problem *problem);
/* Rows of a result, the start included, and the time of each, s. */
int race_rows(const race_problem *problem);
double race_time(const race_problem *problem, int row);
/* State at the start, and the scale of each state: its absolute tolerance is the tolerance times it. */
int race_start(const race_problem *problem, double *start, double *scales);
int race_rates(race_problem *problem, double time, const double *state, double *rates);
/* Column by column. */
int race_jacobian(race_problem *problem, double time, const double *state, double *jacobian);

#ifdef __cplusplus
}
#endif
#endif
