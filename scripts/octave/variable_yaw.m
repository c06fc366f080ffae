function figures = variable_yaw (folder)
  % All toe cases, variable damping, bolster yawed by 0.012 rad (Steets 2007, appendix E.1.2).
  %
  % folder   holds the runs, such as reproduction/runs
  % figures  one structure a figure: name, number in the thesis, handle, axes, texts, curves (label, x, y)

  runs = toe_runs (folder, 'vd', '0.012');
  figures = toe_figures (runs, 'variable_yaw_', -1, {
    'force',             '5-11 a', 'vertical force',     [],      [0.1 10], '';
    'longitudinal',      '5-14 a', 'longitudinal force', [],      [0.1 10], '';
    'dissipation',       '5-16 a', 'dissipation',        [],      [0.1 10], 'southeast';
    'hysteresis',        '5-12',   'hysteresis',         300:700, [],       'southeast';
    'force_near',        '5-11 b', 'vertical force',     [],      [4 7],    '';
    'pitch_moment',      '5-17',   'pitch moment',       [],      [0.1 10], '';
    'yaw_moment',        '5-18',   'yaw moment',         [],      [0.1 10], '';
    'longitudinal_near', '5-14 b', 'longitudinal force', [],      [4 7],    '';
    'dissipation_near',  '5-16 b', 'dissipation',        [],      [4 7],    'southeast'});
end
