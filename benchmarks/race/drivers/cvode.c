/* CVODE (SUNDIALS) in the race: variable-order BDF, Newton's method with the analytic Jacobian, dense factorization.
 *
 * cvode CASE TOLERANCE LIMIT FILE [ROWS]
 *
 * LIMIT is CPU time, s. Writes the states of all rows reached to FILE (double, row by row) and one line of JSON to the
 * standard output. Options beyond CVODE's own defaults: relative tolerance zero and an absolute one of tolerance times
 * scale for each state, as every solver here; no limit of steps between rows; 1000 instead of 7 failed error tests
 * and 1000 instead of 10 failures of Newton's method in one step, without which runs end at impacts. */
#define _POSIX_C_SOURCE 200809L
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>

#include "race.h"

static double seconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int rates(realtype time, N_Vector state, N_Vector out, void *problem) {
    return race_rates(problem, time, N_VGetArrayPointer(state), N_VGetArrayPointer(out));
}

static int jacobian(realtype time, N_Vector state, N_Vector unused, SUNMatrix out, void *problem, N_Vector a, N_Vector b,
                    N_Vector c) {
    (void)unused, (void)a, (void)b, (void)c;
    return race_jacobian(problem, time, N_VGetArrayPointer(state), SUNDenseMatrix_Data(out));
}

/* CVODE's complaints go into the JSON, as its code. */
static void silent(int code, const char *module, const char *function, char *text, void *data) {
    (void)code, (void)module, (void)function, (void)text, (void)data;
}

struct outcome {
    long steps, rejected, derivatives, jacobians, factorizations;
    double cpu, wall, reached;
    char failure[160];
    int rows;
};

/* One integration; the rows go to `states`. */
static int integrate(race_problem *problem, double tolerance, double limit, int rows, double *states,
                     struct outcome *outcome) {
    int n = race_dimension(problem);
    SUNContext context;
    memset(outcome, 0, sizeof *outcome);
    if (SUNContext_Create(NULL, &context)) return 1;
    N_Vector state = N_VNew_Serial(n, context), absolute = N_VNew_Serial(n, context);
    SUNMatrix matrix = SUNDenseMatrix(n, n, context);
    SUNLinearSolver solver = SUNLinSol_Dense(state, matrix, context);
    void *cvode = CVodeCreate(CV_BDF, context);
    double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID), wall = seconds(CLOCK_MONOTONIC);
    race_start(problem, N_VGetArrayPointer(state), N_VGetArrayPointer(absolute));
    N_VScale(tolerance, absolute, absolute);
    int code = CVodeInit(cvode, rates, 0.0, state);
    if (!code) code = CVodeSVtolerances(cvode, 0.0, absolute);
    if (!code) code = CVodeSetUserData(cvode, problem);
    if (!code) code = CVodeSetErrHandlerFn(cvode, silent, NULL);
    if (!code) code = CVodeSetLinearSolver(cvode, solver, matrix);
    if (!code) code = CVodeSetJacFn(cvode, jacobian);
    if (!code) code = CVodeSetMaxNumSteps(cvode, 10000);
    if (!code) code = CVodeSetMaxErrTestFails(cvode, 1000);
    if (!code) code = CVodeSetMaxConvFails(cvode, 1000);
    if (!code) memcpy(states, N_VGetArrayPointer(state), (size_t)n * sizeof(double));
    outcome->rows = 1;
    for (int row = 1; row < rows && !code; row++) {
        double reached = 0.0;
        for (;;) {
            code = CVode(cvode, race_time(problem, row), state, &reached, CV_NORMAL);
            outcome->reached = reached;
            if (seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu > limit && (code == CV_TOO_MUCH_WORK || row + 1 < rows)) {
                snprintf(outcome->failure, sizeof outcome->failure, "out of time at t = %.3f s", reached);
                code = 1;
                break;
            }
            if (code != CV_TOO_MUCH_WORK) break;
        }
        if (code < 0) {
            char *name = CVodeGetReturnFlagName(code);
            snprintf(outcome->failure, sizeof outcome->failure, "%s at t = %.4f s", name, reached);
            free(name);
        } else if (!code) {
            memcpy(states + (size_t)row * (size_t)n, N_VGetArrayPointer(state), (size_t)n * sizeof(double));
            outcome->rows = row + 1;
        }
    }
    outcome->cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
    outcome->wall = seconds(CLOCK_MONOTONIC) - wall;
    CVodeGetNumSteps(cvode, &outcome->steps);
    CVodeGetNumErrTestFails(cvode, &outcome->rejected);
    long failures = 0;
    CVodeGetNumStepSolveFails(cvode, &failures);
    outcome->rejected += failures;
    CVodeGetNumRhsEvals(cvode, &outcome->derivatives);
    CVodeGetNumJacEvals(cvode, &outcome->jacobians);
    CVodeGetNumLinSolvSetups(cvode, &outcome->factorizations);
    CVodeFree(&cvode);
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    N_VDestroy(state);
    N_VDestroy(absolute);
    SUNContext_Free(&context);
    return 0;
}

int main(int count, char **words) {
    if (count < 5) {
        fprintf(stderr, "cvode CASE TOLERANCE LIMIT FILE [ROWS]\n");
        return 2;
    }
    race_problem *problem = race_open(words[1]);
    if (!problem) {
        fprintf(stderr, "there is no problem %s\n", words[1]);
        return 2;
    }
    double tolerance = atof(words[2]), limit = atof(words[3]);
    int rows = race_rows(problem);
    if (count > 5 && atoi(words[5]) < rows) rows = atoi(words[5]);
    double *states = calloc((size_t)rows * (size_t)race_dimension(problem), sizeof(double));
    struct outcome best = {0}, one;
    double spent = 0.0;
    int repeats = 0;
    /* Short runs are repeated; the quickest counts. */
    do {
        if (!states || integrate(problem, tolerance, limit, rows, states, &one)) {
            fprintf(stderr, "CVODE cannot be set up\n");
            return 1;
        }
        if (repeats == 0 || one.cpu < best.cpu) best = one;
        spent += one.cpu;
        repeats++;
    } while (!*one.failure && spent < 0.5 && repeats < 5);
    FILE *file = fopen(words[4], "wb");
    if (!file || fwrite(states, sizeof(double) * (size_t)race_dimension(problem), (size_t)best.rows, file) !=
                     (size_t)best.rows || fclose(file)) {
        fprintf(stderr, "cannot write %s\n", words[4]);
        return 1;
    }
    printf("{\"cpu\": %.6g, \"wall\": %.6g, \"repeats\": %d, \"steps\": %ld, \"rejected\": %ld, \"derivatives\": %ld, "
           "\"jacobians\": %ld, \"factorizations\": %ld, \"rows\": %d, \"failure\": \"%s\"}\n",
           best.cpu, best.wall, repeats, best.steps, best.rejected, best.derivatives, best.jacobians,
           best.factorizations, best.rows, best.failure);
    race_close(problem);
    free(states);
    return 0;
}
