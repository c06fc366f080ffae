function figures = toe_figures (runs, prefix, sign_of_fz, plan)
  % Draws a list of figures that each show one quantity of all three toe cases.
  %
  % runs        out, none, in
  % prefix      beginning of the figures' names
  % sign_of_fz  -1 with variable damping, whose scripts plot -Fz; 1 with constant damping
  % plan        one row a figure: name, number in the thesis, quantity, rows (empty: all), limits in time (empty: none),
  %             place of the legend

  labels = {'Toe Out', 'No Toe', 'Toe In'};
  for row = 1:size (plan, 1)
    [name, number, quantity, rows, limits, place] = plan{row, :};
    x_text = 'Time, (s)';
    for k = 1:3
      run = runs{k};
      x{k} = run.t;
      switch (quantity)
        case 'vertical force'
          y{k} = sign_of_fz * run.Fz;
          y_text = 'Vertical Wedge Force, (lb)';
        case 'longitudinal force'
          y{k} = run.Fx;
          y_text = 'Longitudinal Wedge Force, (lb)';
        case 'dissipation'
          y{k} = run.power;
          y_text = 'Rate of Energy Dissipation, (lb-in/sec)';
        case 'pitch moment'
          y{k} = run.Momentsideframey;
          y_text = 'Pitch Moment, (lb-in)';
        case 'yaw moment'
          y{k} = run.Momentsideframez;
          y_text = 'Yaw Moment, (lb-in)';
        case 'coil force'
          y{k} = run.Fspring2;
          y_text = 'Control Coil Force, (lb)';
        case 'coil force over length'
          x{k} = run.vector;
          y{k} = run.Fspring2;
          x_text = 'Control Coil Length, (in)';
          y_text = 'Control Coil Force, (lb)';
        case 'hysteresis'
          x{k} = run.y(:, 2);
          y{k} = sign_of_fz * run.Fz;
          x_text = 'Vertical Wedge Displacement, (in)';
          y_text = 'Vertical Friction Force, (lb)';
        otherwise
          error ('There is no quantity "%s".', quantity);
      end
      if (~ isempty (rows))
        kept = rows(rows <= numel (x{k}));
        x{k} = x{k}(kept);
        y{k} = y{k}(kept);
      end
    end
    figures(row) = draw ([prefix name], number, x, y, labels, x_text, y_text, limits, [], place);
  end
end
