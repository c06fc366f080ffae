/* The compiled equations for Octave.
 *
 * [start, scales, times] = race_mex (0, NAME)   opens a problem; rows are times, vectors are columns
 * dx = race_mex (1, T, X)                       rates
 * J  = race_mex (2, T, X)                       Jacobian matrix
 * [derivatives, jacobians] = race_mex (3)       calls so far */
#include <mex.h>
#include <string.h>

#include "race.h"

static race_problem *problem;
static double derivatives, jacobians;

static void leave(void) { race_close(problem); }

static void open_problem(mxArray *out[], const mxArray *name) {
    char text[128];
    if (mxGetString(name, text, sizeof text) || !(problem = race_open(text))) mexErrMsgTxt("there is no such problem");
    mexAtExit(leave);
    int n = race_dimension(problem), rows = race_rows(problem);
    out[0] = mxCreateDoubleMatrix(n, 1, mxREAL);
    out[1] = mxCreateDoubleMatrix(n, 1, mxREAL);
    out[2] = mxCreateDoubleMatrix(rows, 1, mxREAL);
    race_start(problem, mxGetPr(out[0]), mxGetPr(out[1]));
    for (int row = 0; row < rows; row++) mxGetPr(out[2])[row] = race_time(problem, row);
    derivatives = jacobians = 0.0;
}

void mexFunction(int outputs, mxArray *out[], int inputs, const mxArray *in[]) {
    int what = inputs > 0 ? (int)mxGetScalar(in[0]) : -1;
    if (what == 0 && inputs == 2 && outputs == 3) {
        open_problem(out, in[1]);
    } else if ((what == 1 || what == 2) && inputs == 3 && problem &&
               (int)mxGetNumberOfElements(in[2]) == race_dimension(problem)) {
        int n = race_dimension(problem);
        out[0] = mxCreateDoubleMatrix(n, what == 1 ? 1 : n, mxREAL);
        double time = mxGetScalar(in[1]), *into = mxGetPr(out[0]);
        const double *state = mxGetPr(in[2]);
        (what == 1 ? &derivatives : &jacobians)[0] += 1.0;
        if (what == 1 ? race_rates(problem, time, state, into) : race_jacobian(problem, time, state, into))
            mexErrMsgTxt("the equations cannot be evaluated");
    } else if (what == 3 && outputs == 2) {
        out[0] = mxCreateDoubleScalar(derivatives);
        out[1] = mxCreateDoubleScalar(jacobians);
    } else {
        mexErrMsgTxt("race_mex: wrong call");
    }
}
