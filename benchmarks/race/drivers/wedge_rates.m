% The wedge's equations of motion in Octave (docs/theory.md, sections 1 to 6): rates of the state.
%
% rates = wedge_rates (t, state, wedge)
%
% State: x, z, pitch, yaw; their rates; energy lost in friction at the column. SI units. `wedge` comes from wedge_case. The eight
% corner-surface pairs are columns: four at the column, four at the slope.
function rates = wedge_rates (t, state, wedge)
  u = state(5:8);
  sp = sin (state(3));
  cp = cos (state(3));
  sy = sin (state(4));
  cy = cos (state(4));
  R = [cp * cy, -cp * sy, sp; sy, cy, 0; -sp * cy, sp * sy, cp];
  omega = [u(4) * sp; u(3); u(4) * cp];
  spin = [0, -omega(3), omega(2); omega(3), 0, -omega(1); -omega(2), omega(1), 0];
  position = [state(1); 0; wedge.nominal_length + state(2)];
  velocity = [u(1); 0; u(2)];

  % The bolster.
  angle = wedge.frequency * t + wedge.phase;
  height = [0; 0; wedge.amplitude * sin(angle)];
  rise = [0; 0; wedge.amplitude * wedge.frequency * cos(angle)];

  % Contact and friction at the corners.
  arms = R * wedge.corners;
  places = position + arms - height * wedge.on_slope;
  velocities = velocity + spin * arms - rise * wedge.on_slope;
  gaps = dot (wedge.normals, places - wedge.planes);
  gap_rates = dot (wedge.normals, velocities);
  N = (gaps < 0) .* max (0, -wedge.contact_stiffness * gaps - wedge.contact_damping * gap_rates);
  slips = velocities - wedge.normals .* gap_rates;
  speeds = max (sqrt (dot (slips, slips)), realmin);
  friction = -(wedge.friction .* N .* tanh (speeds ./ wedge.reference_speed) ./ speeds) .* slips;
  forces = wedge.normals .* N + friction;

  % The control coil; its force passes through the center of gravity.
  d = position - wedge.seat - wedge.seat_on_bolster * height;
  d_rate = velocity - wedge.seat_on_bolster * rise;
  l = norm (d);
  coil = wedge.coil_stiffness * (wedge.free_length - l) * d / l - wedge.coil_damping * d_rate;

  % Force and moment about the center of gravity.
  r = R * wedge.center_of_gravity;
  levers = arms - r;
  F = sum (forces, 2) + coil + wedge.weight;
  moments = levers([2, 3, 1], :) .* forces([3, 1, 2], :) - levers([3, 1, 2], :) .* forces([2, 3, 1], :);
  M = sum (moments, 2) - wedge.rotational_damping * omega;

  % Kane's method.
  e_yaw = [sp; 0; cp];
  I = R * wedge.inertia * R.';
  Jv = [1, 0, r(3), -cp * r(2); 0, 0, 0, cp * r(1) - sp * r(3); 0, 1, -r(1), sp * r(2)];
  Jw = [zeros(3, 2), [0; 1; 0], e_yaw];
  alpha = u(3) * u(4) * [cp; 0; -sp];
  turning = [0, -alpha(3), alpha(2); alpha(3), 0, -alpha(1); -alpha(2), alpha(1), 0] + spin * spin;
  mass = wedge.mass * (Jv.' * Jv) + Jw.' * I * Jw;
  Q = Jv.' * (F - wedge.mass * turning * r) + Jw.' * (M - I * alpha - spin * (I * omega));

  losses = -dot (friction, slips);
  rates = [u; mass \ Q; sum(losses(1 : 4))];
end
