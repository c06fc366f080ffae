function figures = constant_yaw (folder)
  % All toe cases, constant damping, bolster yawed by 0.012 rad (Steets 2007, appendix E.2.2).
  %
  % folder   holds the runs, such as reproduction/runs
  % figures  one structure a figure: name, number in the thesis, handle, axes, texts, curves (label, x, y)

  runs = toe_runs (folder, 'cd', '0.012');
  figures = toe_figures (runs, 'constant_yaw_', 1, {
    'force',             '6-12 a', 'vertical force',     [],      [0.4 10],  '';
    'longitudinal',      '6-15 a', 'longitudinal force', [],      [0.4 10],  'southeast';
    'dissipation',       '6-17 a', 'dissipation',        [],      [0.4 10],  'southeast';
    'hysteresis',        '6-13',   'hysteresis',         350:750, [],        '';
    'pitch_moment',      '6-18',   'pitch moment',       [],      [0.1 10],  '';
    'yaw_moment',        '6-19',   'yaw moment',         [],      [0.1 10],  '';
    'force_near',        '6-12 b', 'vertical force',     [],      [3.8 7.2], 'southeast';
    'longitudinal_near', '6-15 b', 'longitudinal force', [],      [3.8 7.2], '';
    'dissipation_near',  '6-17 b', 'dissipation',        [],      [3.8 7.2], 'southeast'});
end
