function run = load_run (folder, name)
  % The variables of one run: folder/name/result.mat as Wedgelab writes it, or folder/name.mat as the thesis did.

  file = fullfile (folder, name, 'result.mat');
  if (~ exist (file, 'file'))
    other = fullfile (folder, [name '.mat']);
    if (~ exist (other, 'file'))
      error ('There is neither %s nor %s: name the folder that holds the runs, such as reproduction/runs.', file, other);
    end
    file = other;
  end
  run = load (file);
  % The power at the side frame, whatever the damping calls it.
  if (isfield (run, 'EsideframeT'))
    run.power = run.EsideframeT;
  else
    run.power = run.Esideframe;
  end
end
