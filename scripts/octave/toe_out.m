function figures = toe_out (folder)
  % The stand-alone model's curves of the figures that compare it with the vehicle program, toe out (Steets 2007,
  % appendix D; the other program's curves, which are not ours to give, are left out).
  %
  % folder   holds the runs, such as reproduction/runs
  % figures  one structure a figure: name, number in the thesis, handle, axes, texts, curves (label, x, y)
  %
  % Figure 6-11 departs from the thesis's script, which by then has loaded the run without yaw and plots that run's
  % force, with its sign turned, over the yawed run's displacement: here both are of the yawed run.

  variable = load_run (folder, 'vdrun_toe_out_0.2_psi_0');
  variable_yaw = load_run (folder, 'vdrun_toe_out_0.2_psi_0.012');
  constant = load_run (folder, 'cdrun_toe_out_0.2_psi_0');
  constant_yaw = load_run (folder, 'cdrun_toe_out_0.2_psi_0.012');

  time = 'Time, (s)';
  force = 'Vertical Wedge Force, (lb)';
  longitudinal = 'Longitudinal Force, (lb)';
  power = 'Rate of Energy Dissipation, (lb-in/sec)';
  displacement = 'Vertical Wedge Displacement, (in)';
  one = {'Wedgelab'};

  figures = draw ('bolster', '4-1', {variable.t}, {variable.y(:, 5)}, {'z=sin(2t)'}, ...
                  time, 'Vertical Bolster Displacement, (in)', [0 10], [], '');

  % Variable damping; -Fz is the force on the side frame, q2 is counted from the coil's seat, 10.25 in below.
  figures(end+1) = draw ('toe_out_variable_force', '5-1', {variable.t}, {- variable.Fz}, one, time, force, [0 10], [], '');
  figures(end+1) = draw ('toe_out_variable_hysteresis', '5-2', {variable.y(1:400, 2) - 10.25}, ...
                         {- variable.Fz(1:400)}, one, displacement, force, [], [], '');
  figures(end+1) = draw ('toe_out_variable_longitudinal', '5-5', {variable.t}, {variable.Fx}, one, ...
                         time, longitudinal, [0 10], [0 8000], '');
  figures(end+1) = draw ('toe_out_variable_dissipation', '5-7', {variable.t}, {variable.power}, one, ...
                         time, power, [0 10], [], 'southeast');

  % The same with yaw, without the first rows, which are the release of the corners that start inside.
  rows = 5:1000;
  run = variable_yaw;
  figures(end+1) = draw ('toe_out_variable_yaw_force', '5-9', {run.t(rows)}, {- run.Fz(rows)}, one, ...
                         time, force, [0 10], [], '');
  figures(end+1) = draw ('toe_out_variable_yaw_hysteresis', '5-10', {run.y(300:700, 2) - 10.25}, ...
                         {- run.Fz(300:700)}, one, displacement, force, [], [], 'southeast');
  figures(end+1) = draw ('toe_out_variable_yaw_longitudinal', '5-13', {run.t(rows)}, {run.Fx(rows)}, one, ...
                         time, longitudinal, [0 10], [0 6000], '');
  figures(end+1) = draw ('toe_out_variable_yaw_dissipation', '5-15', {run.t(rows)}, {run.power(rows)}, one, ...
                         time, power, [0 10], [], 'southeast');

  % Constant damping; Fz is the wedge's force, the displacement is counted from the middle of its travel, or from 9.95 in.
  run = constant;
  rows = 350:750;
  middle = (max (run.y(:, 2)) + min (run.y(:, 2))) / 2;
  figures(end+1) = draw ('toe_out_constant_force', '6-1', {run.t}, {run.Fz}, one, time, force, [0.5 10], [], '');
  figures(end+1) = draw ('toe_out_constant_hysteresis', '6-2', {run.y(rows, 2) - middle}, {run.Fz(rows)}, one, ...
                         'Vertical Displacement, (in)', force, [-1.1 1.1], [-2100 2600], '');
  figures(end+1) = draw ('toe_out_constant_longitudinal', '6-5', {run.t}, {run.Fx}, one, ...
                         time, longitudinal, [0.5 10], [0 8000], '');
  figures(end+1) = draw ('toe_out_constant_dissipation', '6-7', {run.t}, {run.power}, one, ...
                         time, power, [0.5 10], [], 'southeast');
  run = constant_yaw;
  figures(end+1) = draw ('toe_out_constant_yaw_force', '6-10', {run.t}, {run.Fz}, one, time, force, [0.5 10], [], '');
  figures(end+1) = draw ('toe_out_constant_yaw_hysteresis', '6-11', {run.y(rows, 2) - 9.95}, {run.Fz(rows)}, one, ...
                         'Vertical Displacement, (in)', force, [-1.1 1.1], [], '');
  figures(end+1) = draw ('toe_out_constant_yaw_dissipation', '6-16', {run.t}, {run.power}, one, ...
                         time, power, [0.5 10], [], 'southeast');
  figures(end+1) = draw ('toe_out_constant_both_longitudinal', '6-14', {constant.t, constant_yaw.t}, ...
                         {constant.Fx, constant_yaw.Fx}, {'Vertical', 'Yaw'}, time, longitudinal, [0.5 10], [0 8000], '');
end
