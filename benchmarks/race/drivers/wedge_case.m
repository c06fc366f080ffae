% A case of the race for wedge_rates: the wedge's constants, the start, the error scales, the times of the rows. SI units.
%
% [wedge, start, scales, times] = wedge_case (TEXT)
%
% TEXT is the case as JSON (benchmarks/race/src/wedge_case.rs). Everything that does not change during a run is computed here, once. Names and
% equations are those of docs/theory.md, sections 1 to 6.
function [wedge, start, scales, times] = wedge_case (text)
  case_data = jsondecode (text);
  p = case_data.parameters;
  refuse (p);
  start = case_data.start;
  scales = case_data.scales;
  times = case_data.times;

  % The prism: face A at the column, face S at the slope; four corners each, in the wedge's axes from B.
  [theta, h2, half_width] = deal (p.wedge.angle, p.wedge.height, p.wedge.width / 2);
  h1 = h2 * tan (theta);
  x_a = p.wedge.center_of_gravity(1) - h1 / 3;
  y = half_width * [-1, 1, -1, 1];
  z = [0, 0, h2, h2];
  face_a = [x_a * ones(1, 4); y; z];
  face_s = [x_a + h1, x_a + h1, x_a, x_a; y; z];
  wedge.corners = [face_a, face_s];
  wedge.on_slope = [0, 0, 0, 0, 1, 1, 1, 1];

  % Column and slope: a point of each plane at zero bolster displacement, and the normals towards the wedge.
  height = p.coil.nominal_length + h2 / 2;
  pocket = [x_a + h1 / 2; 0; height];
  phi = p.toe;
  psi = constant (p.bolster.coordinates, 6);
  column_normal = [cos(phi); 0; -sin(phi)];
  slope_normal = -[cos(theta) * cos(psi); cos(theta) * sin(psi); sin(theta)];
  wedge.planes = [repmat([x_a; 0; height], 1, 4), repmat(pocket, 1, 4)];
  wedge.normals = [repmat(column_normal, 1, 4), repmat(slope_normal, 1, 4)];

  % Contact and friction, point by point.
  by_face = @(column, slope) [repmat(column, 1, 4), repmat(slope, 1, 4)];
  wedge.contact_stiffness = p.contact.stiffness;
  wedge.contact_damping = p.contact.damping;
  wedge.friction = by_face (p.column_friction.coefficient, p.slope_friction.coefficient);
  wedge.reference_speed = by_face (p.column_friction.law.reference_speed, p.slope_friction.law.reference_speed);

  % The bolster goes up and down; with constant damping the coil stands in it, turned about the pocket's center.
  sine = motion (p.bolster.coordinates, 3).Sine;
  wedge.amplitude = sine.amplitude;
  wedge.frequency = sine.angular_frequency;
  wedge.phase = sine.phase;
  wedge.seat = zeros (3, 1);
  wedge.seat_on_bolster = strcmp (p.damping, "constant");
  if (wedge.seat_on_bolster)
    wedge.seat = pocket - [cos(psi), -sin(psi), 0; sin(psi), cos(psi), 0; 0, 0, 1] * pocket;
  end
  wedge.coil_stiffness = p.coil.law.linear.stiffness;
  wedge.free_length = p.coil.free_length;
  wedge.nominal_length = p.coil.nominal_length;
  wedge.coil_damping = p.coil.damping;
  wedge.rotational_damping = p.coil.rotational_damping;

  wedge.mass = p.wedge.mass;
  wedge.inertia = diag (p.wedge.inertia);
  wedge.center_of_gravity = p.wedge.center_of_gravity(:);
  wedge.weight = [0; 0; -p.wedge.mass * p.gravity];
end

% The motion of a coordinate (x, y, z, roll, pitch, yaw).
function one = motion (coordinates, number)
  if (iscell (coordinates))
    one = coordinates{number};
  else
    one = coordinates(number);
  end
end

% The value of a coordinate that is held.
function value = constant (coordinates, number)
  one = motion (coordinates, number);
  if (! isfield (one, "Constant"))
    error ("the race's wedge in Octave has this coordinate held: %d", number);
  end
  value = one.Constant;
end

% What wedge_rates does not know must not be asked for.
function refuse (p)
  held = @(neighbour, numbers) all (arrayfun (@(number) constant (neighbour.coordinates, number) == 0, numbers));
  known = isequal (p.wedge.free(:).', logical ([1, 0, 1, 0, 1, 1])) ...
          && strcmp (p.column_friction.law.law, "tanh") && strcmp (p.slope_friction.law.law, "tanh") ...
          && isfield (p.coil.law, "linear") && strcmp (p.coil.acts_at, "center_of_gravity") && p.coil.pulls ...
          && strcmp (p.start, "rest") && p.wear.column == 0 && p.wear.slope == 0 ...
          && isempty (p.side_frame.center) && isempty (p.bolster.center) ...
          && held (p.side_frame, 1:6) && held (p.bolster, [1, 2, 4, 5]) ...
          && isfield (motion (p.bolster.coordinates, 3), "Sine");
  if (! known)
    error ("the race's wedge in Octave has x, z, pitch and yaw free, tanh friction, a linear coil, a bolster in a sine and a still side frame");
  end
end
