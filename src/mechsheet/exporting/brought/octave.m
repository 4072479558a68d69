
% ---- what the equations use --------------------------------------------------------------------------------
% Each behaves as the spreadsheet's function does: no complex numbers, and NaN stays NaN.

function y = direction(x, y0)
% Angle of the vector (x, y0), x first as in a spreadsheet; NaN where it has no length.
  y = atan2(y0, x);
  y((x == 0) & (y0 == 0)) = NaN;
end

function y = root(x)
  y = sqrt(abs(x));
  y(~(x >= 0)) = NaN;
end

function y = arc(inverse, x)
  y = real(inverse(x));
  y(~(abs(x) <= 1)) = NaN;
end

function y = logarithm(x)
  y = log(abs(x));
  y(~(x > 0)) = NaN;
end

function y = raised(base, exponent)
  y = real(base .^ exponent);
  y((base < 0) & (exponent ~= round(exponent))) = NaN;
end

function y = rounded(x, digits)
% Half away from zero.
  y = round(x .* 10 .^ digits) ./ 10 .^ digits;
end

function y = larger(a, b)
  y = max(a, b);
  y(isnan(a) | isnan(b)) = NaN;
end

function y = smaller(a, b)
  y = min(a, b);
  y(isnan(a) | isnan(b)) = NaN;
end

function y = choose(condition, a, b)
% a where the condition holds, b elsewhere; each may be one value for all rows.
  shape = ones(size(condition)) .* ones(size(a)) .* ones(size(b));
  a = a .* shape;
  y = b .* shape;
  condition = logical(condition .* shape);
  y(condition) = a(condition);
end

function y = continuous(x)
% The angles with whole turns added: none is more than half a turn from the one before; anew after one that is no number.
  y = x;
  edges = diff([0; isfinite(x(:)); 0]);
  first = find(edges == 1);
  last = find(edges == -1) - 1;
  for n = 1:numel(first)
    y(first(n):last(n)) = unwrap(x(first(n):last(n)));
  end
end

function y = triangle(c, a, b)
% The angle of a triangle opposite the side c: the law of cosines, by Heron's area, which keeps its digits.
  product = (a + b + c) .* (a + b - c) .* (c + a - b) .* (c - a + b);
  y = atan2(sqrt(max(0, product)), a .^ 2 + b .^ 2 - c .^ 2);
end

function found = followed(step, way, start, there, given, passes, scales)
% Newton's method row by row, each from the row before that has a position: the unknowns side by side, NaN where none is
% found. The determinant's other sign is another assembly. The start fits the described dimensions: from these it goes in
% equal steps, a pass each, to those that are there; a warning says where the assembly ends on the way, and which rows may
% be of another: an unknown, as a part of its scale, leaves its trend.
  found = NaN(size(given, 1), numel(start));
  lead = way(min((0:@@FIRST@@)' / @@LED@@, 1), there);
  x = start;
  xs = zeros(numel(start), size(lead, 1));
  residuals = zeros(1, size(lead, 1));
  signs = zeros(1, size(lead, 1));
  for place = 1:size(lead, 1)
    [correction, residuals(place), determinant] = step(x, lead(place, :));
    xs(:, place) = x;
    signs(place) = sign(determinant);
    if all(isfinite(correction))
      x = x - correction;
    end
  end
  last = xs(:, end);
  begun = residuals(end) <= @@CLOSED@@;
  leaps = abs(diff(xs, 2, 2)) < @@TREND@@ * repmat(scales, 1, size(xs, 2) - 2);
  steady = residuals(3:end) < max(@@STEADY@@ * residuals(2), @@SETTLED@@);
  if ~(all(signs .* signs(1) > 0) && all(leaps(:)) && all(steady))
    what = word_if(begun, 'perhaps these positions are of another', 'no position was found');
    warning('newton:assembly', 'on the way from the described values to these the assembly described ends: %s', what);
  end
  if ~begun
    return
  end
  for row = 1:size(given, 1)
    x = last;
    for pass = 1:passes
      x = x - step(x, given(row, :));
    end
    [~, residual, determinant] = step(x, given(row, :));
    if residual <= @@CLOSED@@ && determinant * signs(end) > 0
      last = x;
      found(row, :) = x';
    end
  end
  warn_of_leaps(found, scales);
end

function warn_of_leaps(found, scales)
% Rows behind others without a position, or in which an unknown leaves its trend, may be of another assembly.
  begun = false;
  count = 0;
  for row = 1:size(found, 1)
    there = isfinite(found(row, 1));
    if there && row > 1
      if ~isfinite(found(row - 1, 1))
        count = count + begun;
      else
        bent = found(row, :) - found(row - 1, :);
        if row > 2 && isfinite(found(row - 2, 1))
          bent = bent - found(row - 1, :) + found(row - 2, :);
        end
        count = count + any(abs(bent) > pi / 180 * @@LEAP@@ * scales');
      end
    end
    begun = begun || there;
  end
  if count > 0
    warning('newton:assembly', '%d rows may be of another assembly: behind others without a position, or a leap', count);
  end
end

function y = kept(x, exists)
% Finite values in rows that exist, NaN elsewhere.
  y = x .* ones(size(exists));
  y(~(exists & isfinite(y))) = NaN;
end

% ---- arguments ---------------------------------------------------------------------------------------------

function value = given(arguments, name, value)
% The value that follows the name among the arguments, or the one of the description.
  for k = 1:2:numel(arguments) - 1
    if strcmp(arguments{k}, name)
      value = arguments{k + 1};
    end
  end
end

function answer = is_given(arguments, name)
  answer = any(strcmp(arguments(1:2:end), name));
end

function check_names(arguments, allowed)
  if mod(numel(arguments), 2) ~= 0
    error('arguments come in pairs: a name and its value');
  end
  for k = 1:2:numel(arguments)
    if ~any(strcmp(arguments{k}, allowed))
      error('nothing is called "%s": %s', num2str(arguments{k}), strjoin(allowed, ', '));
    end
  end
end

% ---- drawing -----------------------------------------------------------------------------------------------

function m = track(rows, varargin)
% One column for each corner, one row for each position.
  m = zeros(rows, numel(varargin));
  for k = 1:numel(varargin)
    m(:, k) = varargin{k};
  end
end

function h = half_window(around, part)
% Half the side of a square around all places, with room for supports, guides and arrows.
  h = part * max(max(around.x(:)) - min(around.x(:)), max(around.y(:)) - min(around.y(:)));
  if isempty(h) || ~(h > 0)
    h = 1;
  end
end

function m = over_motion(take, x, exists)
% The least or the largest over the positions that exist.
  x = x(exists, :);
  if strcmp(take, 'min')
    m = min(x(:));
  else
    m = max(x(:));
  end
end

function s = outlined(x, y, color, width, name)
  s = struct('x', x, 'y', y, 'color', color, 'width', width, 'name', name, 'filled', false);
end

function s = filled(s, color, width)
% The inside of a plate, on its border.
  s.color = color;
  s.width = width;
  s.filled = size(s.x, 2) > 2;
end

function s = placed(rows, a, b, x, y, ax, ay, bx, by, color, width, name)
% Corners (a, b) in a frame: one row for each position.
  each = ones(rows, 1);
  s = outlined((x .* each) + (ax .* each) * a + (bx .* each) * b, (y .* each) + (ay .* each) * a + (by .* each) * b, ...
               color, width, name);
end

function s = large_enough(s, size_, least)
% An arrow of less would be all tip.
  small = ~(size_ .* ones(size(s.x, 1), 1) >= least);
  s.x(small, :) = NaN;
end

function animate(shapes, paths, pins, dots, rows, middle, h, title_text, file)
% All positions that exist, one after the other; without a display, the first of them goes into a file.
  screen = has_display();
  f = figure('visible', word_if(screen, 'on', 'off'), 'color', 'w');
  hold on;
  for k = 1:size(paths.x, 2)
    plot(paths.x(:, k), paths.y(:, k), 'color', [0.56 0.69 0.8], 'linewidth', 1);
  end
  handles = cell(1, numel(shapes));
  for k = 1:numel(shapes)
    s = shapes{k};
    if s.filled
      handles{k} = patch(s.x(rows(1), :), s.y(rows(1), :), s.color, 'edgecolor', s.color, 'linewidth', s.width);
    else
      handles{k} = plot(s.x(rows(1), :), s.y(rows(1), :), 'color', s.color, 'linewidth', max(s.width, 0.5));
    end
  end
  rings = plot(pins.x(rows(1), :), pins.y(rows(1), :), 'o', 'color', [0.25 0.25 0.25], 'markerfacecolor', 'w', ...
               'markersize', 5, 'linestyle', 'none');
  marks = plot(dots.x(rows(1), :), dots.y(rows(1), :), 'o', 'color', [0.25 0.25 0.25], ...
               'markerfacecolor', [0.25 0.25 0.25], 'markersize', 4, 'linestyle', 'none');
  axis equal;
  axis([middle(1) - h, middle(1) + h, middle(2) - h, middle(2) + h]);
  title(title_text, 'interpreter', 'none');
  if ~screen
    save_picture(f, file);
    return
  end
  for r = rows(:)'
    if ~ishandle(f)
      return
    end
    for k = 1:numel(shapes)
      set(handles{k}, 'xdata', shapes{k}.x(r, :), 'ydata', shapes{k}.y(r, :));
    end
    set(rings, 'xdata', pins.x(r, :), 'ydata', pins.y(r, :));
    set(marks, 'xdata', dots.x(r, :), 'ydata', dots.y(r, :));
    drawnow;
    pause(0.04);
  end
end

function curves(number, x, ys, names, x_title, y_title, file)
% Curves over the sweep, or paths of points when there is an x for each y.
  screen = has_display();
  f = figure('visible', word_if(screen, 'on', 'off'), 'color', 'w');
  if size(x, 2) == size(ys, 2) && size(x, 2) > 0 && strcmp(x_title, 'x')
    plot(x, ys, 'linewidth', 1.5);
    axis equal;
  else
    plot(x(:, 1), ys, 'linewidth', 1.5);
  end
  grid on;
  xlabel(x_title, 'interpreter', 'none');
  ylabel(y_title, 'interpreter', 'none');
  legend(names{:});
  if ~screen
    save_picture(f, sprintf('%s-%d', file, number));
  end
end

function list_numbers(result)
% The least and the largest of each quantity over the positions that exist.
  quantities_ = fieldnames(result);
  for k = 1:numel(quantities_)
    column_ = result.(quantities_{k});
    if isnumeric(column_)
      fprintf('%-20s %14.8g ... %.8g\n', quantities_{k}, min(column_(:)), max(column_(:)));
    end
  end
end

function answer = can_draw()
% Octave without a screen and without gnuplot has nothing to draw with.
  answer = true;
  if exist('OCTAVE_VERSION', 'builtin')
    answer = ~isempty(available_graphics_toolkits());
    if ~answer
      fprintf('no pictures: this Octave has nothing to draw with (a display, or gnuplot)\n');
    end
  end
end

function answer = has_display()
  if exist('OCTAVE_VERSION', 'builtin')
    answer = have_window_system();
  else
    answer = usejava('desktop') || ispc() || ismac();
  end
end

function word = word_if(condition, yes, no)
  if condition
    word = yes;
  else
    word = no;
  end
end

function save_picture(f, file)
% As .png, or .svg where that is all that can be written.
  for ending = {'png', 'svg'}
    try
      print(f, [file '.' ending{1}], ['-d' ending{1}]);
      fprintf('%s.%s\n', file, ending{1});
      return
    catch problem
    end
  end
  warning('no picture could be written: %s', problem.message);
end
