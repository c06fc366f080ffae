function figure_drawn = draw (name, number, x, y, labels, x_text, y_text, x_limits, y_limits, place)
  % Draws one figure in the manner of the thesis and says what it has drawn.
  %
  % name, number      its name here and the figure's number in the thesis, empty if it has none
  % x, y, labels      cells of columns and texts, one a curve
  % x_limits, y_limits  as [low high]; empty: as the curves need it
  % place             of the legend; empty: as Octave or MATLAB would

  styles = {'b', '--r', 'g'};
  if (numel (x) == 1)
    styles = {'b'};
  end
  handle = figure ('name', name, 'numbertitle', 'off');
  for k = 1:numel (x)
    plot (x{k}, y{k}, styles{k});
    hold on
  end
  hold off
  if (~ isempty (x_limits))
    xlim (x_limits);
  end
  if (~ isempty (y_limits))
    ylim (y_limits);
  end
  xlabel (x_text, 'fontsize', 16);
  ylabel (y_text, 'fontsize', 16);
  axes_drawn = gca ();
  if (isempty (place))
    legend (labels{:});
  else
    legend (labels{:}, 'location', place);
  end
  curves = struct ('label', labels, 'x', x, 'y', y);
  figure_drawn = struct ('name', name, 'thesis', number, 'handle', handle, 'axes', axes_drawn, ...
                         'x_text', x_text, 'y_text', y_text);
  figure_drawn.curves = curves;
end
