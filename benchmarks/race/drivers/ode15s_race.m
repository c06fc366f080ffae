% Octave's ode15s in the race.
%
% octave-cli ode15s_race.m EQUATIONS FROM CASE TOLERANCE LIMIT FILE ROWS
%
% EQUATIONS is `compiled` (right-hand side and Jacobian matrix are compiled: race_mex in the folder FROM) or `octave` (wedge_rates.m, with
% the case FROM, the JSON that wedge_case takes; ode15s forms the Jacobian matrix by differences of its own). LIMIT is CPU time, s. Writes the
% states of all rows reached to FILE (double, row by row) and one line of JSON to the standard output. Options beyond the defaults: a first
% step of 1e-9 s, without which it fails at once; relative tolerance 1e-13 and an absolute one of tolerance times scale for each state, as
% every solver here. It is asked for its steps, not for rows: between two rows it makes 500 steps at most, and fails here. Rows are taken from
% the steps by cubic Hermite polynomials, outside the time measured.
1;

function stop = watch (t, x, flag, begun, limit)
  stop = false;
  if (isempty (flag))
    stop = cputime () - begun > limit;
  end
end

words = argv ();
[equations, from, name, file] = words{[1, 2, 3, 6]};
tolerance = str2double (words{4});
limit = str2double (words{5});
compiled = strcmp (equations, "compiled");
if (compiled)
  addpath (from);
  [start, scales, times] = race_mex (0, name);
  rates = @(t, x) race_mex (1, t, x);
else
  addpath (fileparts (mfilename ("fullpath")));
  [wedge, start, scales, times] = wedge_case (from);
  rates = @(t, x) wedge_rates (t, x, wedge);
end
times = times(1 : min (end, str2double (words{7})));
begun = cputime ();
clock = tic ();
options = odeset ("RelTol", 1e-13, "AbsTol", tolerance * scales, "InitialStep", 1e-9, ...
                  "OutputFcn", @(t, x, flag) watch (t, x, flag, begun, limit));
if (compiled)
  options = odeset (options, "Jacobian", @(t, x) race_mex (2, t, x));
end
failure = "";
reached = 0;
steps = start.';
try
  [reached, steps] = ode15s (rates, times([1, end]), start, options);
  if (reached(end) < times(end))
    failure = sprintf ("out of time at t = %.3f s", reached(end));
  end
catch problem
  failure = strrep (strtrim (problem.message), "\"", "'");
end
cpu = cputime () - begun;
wall = toc (clock);
% Zero: not counted. A count in Octave would cost what is measured.
[derivatives, jacobians] = deal (0);
if (compiled)
  [derivatives, jacobians] = race_mex (3);
end
times = times(times <= reached(end));
states = start.';
if (numel (times) > 1)
  places = max (1, min (numel (reached) - 1, lookup (reached, times)));
  states = zeros (numel (times), numel (start));
  for row = 1 : numel (times)
    k = places(row);
    h = reached(k + 1) - reached(k);
    s = (times(row) - reached(k)) / h;
    [a, b] = deal (steps(k, :), steps(k + 1, :));
    da = h * rates (reached(k), a.').';
    db = h * rates (reached(k + 1), b.').';
    states(row, :) = a + s * (b - a) + s * (1 - s) * ((1 - s) * (da - (b - a)) + s * (b - a - db));
  end
end
file = fopen (file, "w");
fwrite (file, states.', "double");
fclose (file);
printf (["{\"cpu\": %.6g, \"wall\": %.6g, \"repeats\": 1, \"steps\": %d, \"rejected\": 0, \"derivatives\": %d, ", ...
         "\"jacobians\": %d, \"factorizations\": 0, \"rows\": %d, \"failure\": \"%s\"}\n"], ...
        cpu, wall, numel (reached) - 1, derivatives, jacobians, rows (states), failure);
