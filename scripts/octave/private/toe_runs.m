function runs = toe_runs (folder, damping, yaw)
  % The three runs that a figure of all toe cases compares: out, none, in.
  %
  % damping  'vd' (variable) or 'cd' (constant)
  % yaw      of the bolster as the run names have it: '0' or '0.012'

  names = {'out_0.2', '0', 'in_0.2'};
  for k = 1:3
    runs{k} = load_run (folder, [damping 'run_toe_' names{k} '_psi_' yaw]);
  end
end
