function figures = constant_vertical (folder)
  % All toe cases, constant damping, bolster not yawed (Steets 2007, appendix E.2.1).
  %
  % folder   holds the runs, such as reproduction/runs
  % figures  one structure a figure: name, number in the thesis, handle, axes, texts, curves (label, x, y)
  %
  % The last figure is not in the thesis, whose script loads the coil's length but does not plot it.

  runs = toe_runs (folder, 'cd', '0');
  figures = toe_figures (runs, 'constant_vertical_', 1, {
    'force',             '6-3 a', 'vertical force',         [],      [0.5 10],  '';
    'longitudinal',      '6-6 a', 'longitudinal force',     [],      [0.5 10],  '';
    'dissipation',       '6-8 a', 'dissipation',            [],      [0.5 10],  'southeast';
    'hysteresis',        '6-4',   'hysteresis',             350:750, [],        '';
    'coil_force',        '',      'coil force',             [],      [],        '';
    'force_near',        '6-3 b', 'vertical force',         [],      [3.5 7.5], '';
    'longitudinal_near', '6-6 b', 'longitudinal force',     [],      [3.5 7.5], '';
    'dissipation_near',  '6-8 b', 'dissipation',            [],      [3.5 7.5], 'southeast';
    'pitch_moment',      '6-9',   'pitch moment',           [],      [0 10],    'southeast';
    'yaw_moment',        '',      'yaw moment',             [],      [0 10],    'southeast';
    'coil_over_length',  '',      'coil force over length', [],      [],        ''});
end
