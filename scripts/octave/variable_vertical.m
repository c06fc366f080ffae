function figures = variable_vertical (folder)
  % All toe cases, variable damping, bolster not yawed (Steets 2007, appendix E.1.1).
  %
  % folder   holds the runs, such as reproduction/runs
  % figures  one structure a figure: name, number in the thesis, handle, axes, texts, curves (label, x, y)

  runs = toe_runs (folder, 'vd', '0');
  figures = toe_figures (runs, 'variable_vertical_', -1, {
    'force',             '5-3 a', 'vertical force',     [],      [0 10], '';
    'force_near',        '5-3 b', 'vertical force',     [],      [4 7],  '';
    'longitudinal',      '5-6 a', 'longitudinal force', [],      [0 10], '';
    'dissipation',       '5-8 a', 'dissipation',        [],      [0 10], 'southeast';
    'hysteresis',        '5-4',   'hysteresis',         1:400,   [],     'southeast';
    'longitudinal_near', '5-6 b', 'longitudinal force', 400:700, [4 7],  '';
    'dissipation_near',  '5-8 b', 'dissipation',        [],      [4 7],  'southeast'});
end
