% Direct model and one observation with Octave, result as JSON on stdout: octave-cli direct.m PROBLEM.json
% lsqnonlin|fsolve
%
% Unknowns of the direct model: p, rotation vector v with R = exp([v]), force (fx, fz) on every cable at its
% anchor point A_i. Equations, with r_i = p + R a_i - b_i, Eq. (1), h_i and z_i its horizontal length and
% height, e_i = (r_x/h, r_y/h):
%
%   sum F_i + m g = 0,  F_i = -(fx e_i, fz),  g = (0, 0, -9.81) m/s^2                  [N]     Eq. (3)
%   sum (R a_i) x F_i + (R c) x m g = 0                                                [N m]   Eq. (3)
%   h = fx L/EA + fx/w (asinh(fz/fx) - asinh((fz - w L)/fx))                           [mm]    Eq. (2a)
%   z = fz L/EA - w L^2/(2 EA) + (sqrt(fx^2 + fz^2) - sqrt(fx^2 + (fz - w L)^2))/w     [mm]    Eq. (2b)
%
% Inverse model, with the direction (cos s, sin s) of each cable's force, R = 1:
%
%   minimize  sum t_i^2  over t, s, L   subject to   (3) without payload, (2a), (2b) with fx = t cos s,
%   fz = t sin s, and least_i <= t_i <= greatest_i
%
% Observation: inverse model of the robot with deviations, tension offsets dt, lengths for these, direct model
% without and with the payload, difference of the positions.
%
% Solvers: lsqnonlin of package optim (Levenberg-Marquardt), or fsolve (dog leg), with forward differences;
% sqp for the inverse model.

1; % a script, not a function file

function [x, z] = catenary(fx, fz, l, w, ea)
  v0 = fz - w * l;
  x = fx .* l / ea + fx / w .* (asinh(fz ./ fx) - asinh(v0 ./ fx));
  z = fz .* l / ea - w * l.^2 / (2 * ea) + (sqrt(fx.^2 + fz.^2) - sqrt(fx.^2 + v0.^2)) / w;
end

function matrix = cross_matrix(v)
  matrix = [0, -v(3), v(2); v(3), 0, -v(1); -v(2), v(1), 0];
end

% Points and forces are the columns of 3 x m matrices; angles, lengths and tensions are rows.
function robot = make_robot(problem, parameters)
  robot.mg = -problem.gravity * parameters(1);
  robot.w = problem.gravity * parameters(2);
  robot.ea = problem.section * parameters(3);
  m = numel(problem.lengths);
  robot.a = reshape(parameters(3 + (1:3*m)), 3, m);
  robot.b = reshape(parameters(3 + 3*m + (1:3*m)), 3, m);
  robot.center = parameters(6*m + (4:6));
  robot.dt = parameters(6*m + 6 + (1:m))';
  robot.least = problem.least;
  robot.greatest = problem.greatest;
end

function wrench = weight(mg, center)
  wrench = mg * [0; 0; 1; center(2); -center(1); 0];
end

function [e, h, z] = spans(robot, position, arms)
  r = position + arms - robot.b;
  h = sqrt(r(1, :).^2 + r(2, :).^2);
  e = r(1:2, :) ./ h;
  z = r(3, :);
end

% The 6 + 2m equations; mg is the weight of the platform with what it carries.
function open = residual(robot, x, lengths, mg)
  rotation = turned(x(4:6));
  f = reshape(x(7:end), 2, []);
  arms = rotation * robot.a;
  [e, h, z] = spans(robot, x(1:3), arms);
  forces = [f(1, :) .* e; f(2, :)];
  m = arms * forces';
  moment = [m(2, 3) - m(3, 2); m(3, 1) - m(1, 3); m(1, 2) - m(2, 1)];
  [xc, zc] = catenary(f(1, :), f(2, :), lengths, robot.w, robot.ea);
  open = [[sum(forces, 2); moment] - weight(mg, rotation * robot.center); 1e3 * (h - xc)'; 1e3 * (z - zc)'];
end

function rotation = turned(v)
  angle = norm(v);
  k = cross_matrix(v);
  if angle > 0
    rotation = eye(3) + sin(angle) / angle * k + 2 * (sin(angle / 2) / angle)^2 * k * k;
  else
    rotation = eye(3);
  end
end

function x = direct(robot, lengths, payload, start)
  global solve gravity
  x = solve(@(x) residual(robot, x, lengths, robot.mg - gravity * payload), start);
end

% Angles and lengths of cables with given ends and tensions.
function [angles, lengths] = held(robot, tensions, h, z, angles, lengths)
  global solve
  x = solve(@(x) open_ends(robot, tensions, h, z, x), [angles, lengths]');
  m = numel(h);
  angles = x(1:m)';
  lengths = x(m+1:end)';
end

function open = open_ends(robot, tensions, h, z, x)
  m = numel(h);
  fx = tensions .* cos(x(1:m)');
  fz = tensions .* sin(x(1:m)');
  [xc, zc] = catenary(fx, fz, x(m+1:end)', robot.w, robot.ea);
  open = [h - xc, z - zc]';
end

% Least-norm tensions within the limits, angles, lengths at a position with R = 1. The unknowns of sqp are the
% tensions in units of the weight, angles, lengths in units of the chord.
function [tensions, angles, lengths] = inverse(robot, position)
  [e, h, z] = spans(robot, position, robot.a);
  m = numel(h);
  chord = hypot(h, z);
  angles = atan2(z, h);
  force = abs(robot.mg);
  pulls = [cos(angles) .* e; sin(angles)];
  straight = pinv([pulls; cross(robot.a, pulls)]) * weight(robot.mg, robot.center);
  start = [min(max(straight, robot.least), robot.greatest) / force; angles'; ones(m, 1)];
  objective = {@(x) x(1:m)' * x(1:m) / 2, @(x) [x(1:m); zeros(2*m, 1)]};
  constraints = {@(x) open_inverse(robot, e, h, z, force, x), ...
                 @(x) complex_step(@(x) open_inverse(robot, e, h, z, force, x), x)};
  free = [pi / 2 * ones(m, 1); inf(m, 1)]; % a cable of which cos s < 0 would push
  [x, ~, info] = sqp(start, objective, constraints, [], [robot.least / force; -free], ...
                     [robot.greatest / force; free], 200, 1e-10);
  if !any(info == [101, 104]) || max(abs(constraints{1}(x))) > 1e-11 % 104: the steps have become too small
    error("sqp: info %d", info);
  end
  tensions = force * x(1:m)';
  angles = x(m+1:2*m)';
  lengths = chord .* x(2*m+1:end)';
end

function open = open_inverse(robot, e, h, z, force, x)
  m = numel(h);
  chord = hypot(h, z);
  t = force * x(1:m).';
  fx = t .* cos(x(m+1:2*m).');
  fz = t .* sin(x(m+1:2*m).');
  forces = [fx .* e; fz];
  [xc, zc] = catenary(fx, fz, chord .* x(2*m+1:end).', robot.w, robot.ea);
  moments = robot.a * forces.';
  moment = [moments(2, 3) - moments(3, 2); moments(3, 1) - moments(1, 3); moments(1, 2) - moments(2, 1)];
  balance = [sum(forces, 2); moment] - weight(robot.mg, robot.center);
  arm = max(abs(robot.a(:)));
  open = [balance ./ (force * [1; 1; 1; arm; arm; arm]); ((h - xc) ./ chord).'; ((z - zc) ./ chord).'];
end

function jacobian = complex_step(f, x)
  n = numel(x);
  for k = 1:n
    step = zeros(n, 1);
    step(k) = 1e-30i;
    jacobian(:, k) = imag(f(x + step)) / 1e-30;
  end
end

function dp = observation(robot, position, payload)
  [tensions, angles, lengths] = inverse(robot, position);
  [~, h, z] = spans(robot, position, robot.a);
  % A set-point stays within the limits.
  tensions = min(max(tensions + robot.dt, robot.least'), robot.greatest');
  [angles, lengths] = held(robot, tensions, h, z, angles, lengths);
  forces = [tensions .* cos(angles); tensions .* sin(angles)];
  unloaded = direct(robot, lengths, 0, [position; 0; 0; 0; forces(:)]);
  loaded = direct(robot, lengths, payload, unloaded);
  dp = loaded(1:3) - unloaded(1:3);
end

% Result, and CPU times [us]; the first call is not timed.
function [result, times] = timed(run, repeats)
  result = run();
  times = zeros(1, repeats);
  for i = 1:repeats
    begin = cputime();
    run();
    times(i) = 1e6 * (cputime() - begin);
  end
end

% Displacements, one a row, and CPU times [us].
function [displacements, times] = observations(problem, repeats)
  displacements = times = [];
  for deviation = problem.deviations'
    run = @() observation(make_robot(problem, problem.parameters + deviation), ...
                          problem.position, problem.payload);
    [displacements(end + 1, :), taken] = timed(run, repeats);
    times = [times, taken];
  end
end

% Both results; NaN, which is null in JSON, if a solver has not converged.
function [result, times] = or_nan(problem, run)
  try
    [result, times] = run();
  catch failure
    fprintf(stderr, "%s: %s\n", problem.name, failure.message);
    result = times = NaN;
  end
end

% Answers and times of a case.
function answer = answer_of(problem, repeats)
  global gravity
  gravity = problem.gravity;
  start = [problem.position; 0; 0; 0; problem.forces'(:)];
  robot = make_robot(problem, problem.parameters);
  [loaded, direct_times] = timed(@() direct(robot, problem.lengths', problem.payload, start), repeats);
  [tensions, inverse_times] = or_nan(problem, @() timed(@() inverse(robot, problem.position), repeats));
  [displacements, times] = or_nan(problem, @() observations(problem, repeats));
  answer = struct("direct_us", median(direct_times), "direct_position", loaded(1:3), ...
                  "inverse_us", median(inverse_times), "tensions", tensions, ...
                  "observation_us", median(times), "displacements", displacements);
end

global solve
warning("off", "Octave:shadowed-function");
args = argv();
if strcmp(args{2}, "lsqnonlin")
  pkg load optim
  options = optimset("TolFun", 1e-10, "TolX", 1e-10, "Display", "off");
  solve = @(f, start) lsqnonlin(f, start, [], [], options);
else
  options = optimset("TolFun", 1e-12, "TolX", 1e-10, "AutoScaling", "on");
  solve = @(f, start) fsolve(f, start, options);
end
problem = jsondecode(fileread(args{1}));
answers = {};
for i = 1:numel(problem.cases)
  if iscell(problem.cases)
    answers{i} = answer_of(problem.cases{i}, problem.repeats);
  else
    answers{i} = answer_of(problem.cases(i), problem.repeats);
  end
end
disp(jsonencode(struct("version", OCTAVE_VERSION, "solver", [args{2} ", sqp; differences"], ...
                        "cases", {answers})));
