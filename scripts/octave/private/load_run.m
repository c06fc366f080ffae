function run = load_run (folder, name)
  % The variables of one run: folder/name/result.mat as Wedgelab writes it, or folder/name.mat as the thesis did,
  % with a sign for the direction of the toe: -0.2 is toe out.

  file = fullfile (folder, name, 'result.mat');
  if (~ exist (file, 'file'))
    signed = strrep (strrep (name, 'toe_out_', 'toe_-'), 'toe_in_', 'toe_');
    other = fullfile (folder, [signed '.mat']);
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
