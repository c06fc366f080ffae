% Octave's ode15s in the race, with the compiled right-hand side and Jacobian matrix (race_mex).
%
% octave-cli ode15s_race.m FOLDER CASE TOLERANCE LIMIT FILE ROWS
%
% FOLDER holds race_mex; LIMIT is CPU time, s. Writes the states of all rows reached to FILE (double, row by row) and one line of JSON to
% the standard output. Options beyond the defaults: a first step of 1e-9 s, without which it fails at once; relative tolerance
% 1e-13 and an absolute one of tolerance times scale for each state, as every solver here. ode15s does not tell its steps.
1;

function stop = watch (t, x, flag, begun, limit)
  persistent rows = 0;
  stop = false;
  if (isempty (flag))
    stop = cputime () - begun > limit;
  end
end

words = argv ();
addpath (words{1});
tolerance = str2double (words{3});
limit = str2double (words{4});
[start, scales, times] = race_mex (0, words{2});
times = times(1 : min (end, str2double (words{6})));
begun = cputime ();
clock = tic ();
options = odeset ("RelTol", 1e-13, "AbsTol", tolerance * scales, "InitialStep", 1e-9, ...
                  "Jacobian", @(t, x) race_mex (2, t, x), "OutputFcn", @(t, x, flag) watch (t, x, flag, begun, limit));
failure = "";
states = start.';
try
  [reached, states] = ode15s (@(t, x) race_mex (1, t, x), times, start, options);
  if (numel (reached) < numel (times))
    failure = sprintf ("out of time at t = %.3f s", reached(end));
  end
catch problem
  failure = strrep (strtrim (problem.message), "\"", "'");
end
cpu = cputime () - begun;
wall = toc (clock);
[derivatives, jacobians] = race_mex (3);
file = fopen (words{5}, "w");
fwrite (file, states.', "double");
fclose (file);
printf (["{\"cpu\": %.6g, \"wall\": %.6g, \"repeats\": 1, \"steps\": 0, \"rejected\": 0, \"derivatives\": %d, ", ...
         "\"jacobians\": %d, \"factorizations\": 0, \"rows\": %d, \"failure\": \"%s\"}\n"], ...
        cpu, wall, derivatives, jacobians, rows (states), failure);
