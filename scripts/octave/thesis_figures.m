function figures = thesis_figures (folder)
  % All figures of the stand-alone model in Steets (2007), from Wedgelab's twelve runs; for Octave and MATLAB.
  %
  %   wedgelab reproduce                                        (in a shell)
  %   addpath scripts/octave
  %   figures = thesis_figures ('reproduction/runs');
  %   save_curves (figures, 'curves');
  %
  % folder   holds the runs, each as NAME/result.mat or NAME.mat
  % figures  one structure a figure: name, number in the thesis, handle, axes, texts, curves (label, x, y)
  %
  % Times, ranges of rows and limits of the axes are those of the thesis's own scripts (appendices D and E).

  figures = [variable_vertical(folder), variable_yaw(folder), constant_vertical(folder), ...
             constant_yaw(folder), toe_out(folder)];
end
