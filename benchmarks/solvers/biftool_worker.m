% Cycles of the block by DDE-BIFTOOL along one parameter, from each Hopf point, and their special points (cycles.py):
%   octave-cli biftool_worker.m FOLDER PARAMETER
% PARAMETER is a number from 1. The task has its window, intervals, degree, most orbits, then tau, epsilon, xi and gamma.
% Rows are: 0, the orbits of a branch, the largest error of their multipliers; then for each special point 1 for a fold,
% 2 for a torus or 3 for a period doubling, its place, and its period. Seconds are those of the branches.
1;

% The right-hand side of (4) for theta, u and ln v, and its derivatives along a direction.
function f = rate(x, p, dx, dp, order)
  [theta, u, w, past] = deal(x(1,1,:), x(2,1,:), x(3,1,:), x(3,2,:));
  [d_theta, d_u, d_w, d_past] = deal(dx(1,1,:), dx(2,1,:), dx(3,1,:), dx(3,2,:));
  v = exp(w);
  state = theta + (1 + p(2))*past;
  force = u + (theta + w)/p(3);
  d_state = d_theta + dp(2)*past + (1 + p(2))*d_past;
  d_force = d_u + (d_theta + d_w)/p(3) - dp(3)*(theta + w)/p(3)^2;
  stiffness = p(4)^2./v;
  switch order
    case 0
      f = [-v.*state; v - 1; -stiffness.*force];
    case 1
      f = [-v.*(d_w.*state + d_state); v.*d_w; -stiffness.*(d_force - d_w.*force)];
    case 2
      dd_force = 2*dp(3)^2*(theta + w)/p(3)^3 - 2*dp(3)*(d_theta + d_w)/p(3)^2;
      f = [-v.*(d_w.^2.*state + 2*d_w.*d_state + 2*dp(2)*d_past);
           v.*d_w.^2;
           -stiffness.*(dd_force - 2*d_w.*d_force + d_w.^2.*force)];
  end
end

% In place of DDE-BIFTOOL's function of this name, which fails in Octave 7 where a problem has no conditions of
% its own.
function [residual, jacobian] = dde_sys_cond_collect(~, point, reference, conditions)
  [residual, jacobian] = deal([]);
  for i = 1:numel(conditions)
    [value, derivative] = conditions{i}(point, reference);
    residual = [residual; value(:)];
    jacobian = [jacobian; derivative(:)];
  end
end

% The CPU time of a branch, and its rows.
function [seconds, rows] = follow(problem, steady, at, settings)
  branch = SetupPsol(problem, steady, at, 'intervals', settings.intervals, 'degree', settings.degree, ...
                     'radius', 0.05, 'matrix', 'sparse', settings.bounds{:}, ...
                     'max_step', [0, 0.3; settings.parameter, diff(settings.window)/50]);
  branch.method.continuation.plot = 0;
  start = cputime;
  branch = br_contn(problem, branch, settings.orbits);
  [unstable, ~, error, branch.point] = ...
      GetStability(branch, 'funcs', problem, 'exclude_trivial', true);
  seconds = cputime - start;
  rows = [0, numel(branch.point), max(error)];
  place = arrayfun(@(orbit) orbit.parameter(settings.parameter), branch.point);
  for i = 2:numel(place) - 1
    step = diff(place(i-1:i+1));
    more = abs(unstable(i+1) - unstable(i));
    if prod(step) < 0
      rows = [rows; locate(problem, branch, i, 1, @SetupPOfold, settings)];
    elseif more == 2
      rows = [rows; locate(problem, branch, i, 2, @SetupTorusBifurcation, settings)];
    elseif more == 1 && prod(diff(place(i:min(i+2, end)))) > 0
      rows = [rows; locate(problem, branch, i, 3, @SetupPeriodDoubling, settings)];
    end
  end
end

% From the orbit before the point, and if that fails from the one behind it; on a finer mesh.
function row = locate(problem, branch, i, kind, set_up, settings)
  row = [];
  orbits = branch.point(i:i+1);
  for k = 1:2
    branch.point = p_remesh(orbits(k), settings.degree, round(1.5*settings.intervals));
    [~, found, converged] = set_up(problem, branch, 1, 'contpar', settings.parameter, 'dir', [], ...
                                   'print_residual_info', 0);
    if converged
      row = [kind, found.point(1).parameter(settings.parameter), found.point(1).period];
      return
    end
  end
end

% A line of standard input. fgetl waits for the first letter of the line after it.
function line = read_line()
  line = '';
  while ! isempty(letter = fread(stdin, 1, 'char=>char')) && letter != "\n"
    line(end+1) = letter;
  end
end

warning('off', 'all');
sigterm_dumps_octave_core(false);  % an interrupted run leaves no file
given = argv();
for folder = {'ddebiftool', 'ddebiftool_extra_psol', 'ddebiftool_extra_nmfm', 'ddebiftool_utilities'}
  addpath(fullfile(given{1}, folder{1}));
end
task = str2num(read_line());
settings.parameter = str2double(given{2});
settings.window = task(1:2);
settings.intervals = task(3);
settings.degree = task(4);
settings.orbits = task(5);
settings.bounds = {'min_bound', [settings.parameter, settings.window(1)], ...
                   'max_bound', [settings.parameter, settings.window(2)]};
parameters = task(6:9);
problem = set_funcs('sys_rhs', @(x, p) rate(x, p, 0*x, 0*p, 0), 'sys_tau', @() 1, ...
                    'sys_dirderi', {@(x, p, dx, dp) rate(x, p, dx, dp, 1), ...
                                    @(x, p, dx, dp) rate(x, p, dx, dp, 2)}, 'x_vectorized', true);
printf('answer: %s\n', version);
fflush(stdout);
while ! isempty(line = read_line())
  path = strsplit(line, ' '){3};
  steady = SetupStst(problem, 'x', [0; 0; 0], 'parameter', parameters, 'contpar', settings.parameter, ...
                     settings.bounds{:}, 'max_step', [settings.parameter, diff(settings.window)/80], ...
                     'minimal_real_part', -0.3);
  steady.method.continuation.plot = 0;
  steady = br_contn(problem, steady, 300);
  [~, ~, ~, steady.point] = GetStability(steady, 'funcs', problem);
  [steady, ~, hopf] = LocateSpecialPoints(problem, steady);
  [total, rows] = deal(0, []);
  for at = hopf
    [seconds, more] = follow(problem, steady, at, settings);
    [total, rows] = deal(total + seconds, [rows; more]);
  end
  dlmwrite(path, rows, 'delimiter', ' ', 'precision', 17);
  printf('answer: %.3f ok\n', total);
  fflush(stdout);
end
