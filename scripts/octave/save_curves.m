function save_curves (figures, folder)
  % Saves the plotted curves, one text file a curve: NAME_LABEL.csv with the columns x and y.
  %
  % figures  as from thesis_figures
  % folder   is made if there is none

  if (~ exist (folder, 'dir'))
    mkdir (folder);
  end
  for k = 1:numel (figures)
    for curve = figures(k).curves
      label = lower (regexprep (curve.label, '[^A-Za-z0-9]+', '_'));
      file = fopen (fullfile (folder, [figures(k).name '_' label '.csv']), 'w');
      fprintf (file, '"%s","%s"\n', figures(k).x_text, figures(k).y_text);
      fprintf (file, '%.17g,%.17g\n', [curve.x(:), curve.y(:)].');
      fclose (file);
    end
  end
end
