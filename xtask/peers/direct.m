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
% Inverse model: least-norm tensions t = -W^T (W W^T)^-1 w_ex, W from the directions of the cables at the
% platform; then for every cable the unknowns (angle, L) of Eq. (2a), (2b) with fx = t cos, fz = t sin; again,
% until the directions stop moving.
%
% Observation: inverse model of the robot with deviations, tension offsets dt, lengths for these, direct model
% without and with the payload, difference of the positions.
%
% Solver: lsqnonlin of package optim (Levenberg-Marquardt), or fsolve (dog leg); forward differences.

1; % a script, not a function file

function [x, z] = catenary(fx, fz, l, w, ea)
  v0 = fz - w * l;
  x = fx .* l / ea + fx / w .* (asinh(fz ./ fx) - asinh(v0 ./ fx));
  z = fz .* l / ea - w * l.^2 / (2 * ea) + (sqrt(fx.^2 + fz.^2) - sqrt(fx.^2 + v0.^2)) / w;
end

function matrix = cross_matrix(v)
  matrix = [0, -v(3), v(2); v(3), 0, -v(1); -v(2), v(1), 0];
end

% Points and forces are the columns of 3 x 8 matrices; angles, lengths and tensions are rows.
function robot = make_robot(problem, parameters)
  robot.mg = -problem.gravity * parameters(1);
  robot.w = problem.gravity * parameters(2);
  robot.ea = problem.section * parameters(3);
  robot.a = reshape(parameters(4:27), 3, 8);
  robot.b = reshape(parameters(28:51), 3, 8);
  robot.center = parameters(52:54);
  robot.dt = parameters(55:62)';
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

% The 22 equations; mg is the weight of the platform with what it carries.
function open = residual(robot, x, lengths, mg)
  rotation = turned(x(4:6));
  f = reshape(x(7:22), 2, 8);
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
  global solve problem
  x = solve(@(x) residual(robot, x, lengths, robot.mg - problem.gravity * payload), start);
end

% Angles and lengths of cables with given ends and tensions.
function [angles, lengths] = held(robot, tensions, h, z, angles, lengths)
  global solve
  x = solve(@(x) open_ends(robot, tensions, h, z, x), [angles, lengths]');
  angles = x(1:8)';
  lengths = x(9:16)';
end

function open = open_ends(robot, tensions, h, z, x)
  [xc, zc] = catenary(tensions .* cos(x(1:8)'), tensions .* sin(x(1:8)'), x(9:16)', robot.w, robot.ea);
  open = [h - xc, z - zc]';
end

% Least-norm tensions, angles, lengths at a position with R = 1.
function [tensions, angles, lengths] = inverse(robot, position)
  [e, h, z] = spans(robot, position, robot.a);
  angles = atan2(z, h);
  lengths = hypot(h, z);
  do
    pulls = -[cos(angles) .* e; sin(angles)];
    matrix = [pulls; cross(robot.a, pulls)];
    tensions = -(matrix' * ((matrix * matrix') \ weight(robot.mg, robot.center)))';
    before = angles;
    [angles, lengths] = held(robot, tensions, h, z, angles, lengths);
  until max(abs(angles - before)) < 1e-12
end

function dp = observation(robot, position, payload)
  [tensions, angles, lengths] = inverse(robot, position);
  [~, h, z] = spans(robot, position, robot.a);
  tensions += robot.dt;
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

global solve problem
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
start = [problem.position; 0; 0; 0; problem.forces'(:)];
robot = make_robot(problem, problem.parameters);
[loaded, direct_times] = timed(@() direct(robot, problem.lengths', problem.payload, start), problem.repeats);
displacements = [];
times = [];
for deviation = problem.deviations'
  run = @() observation(make_robot(problem, problem.parameters + deviation), ...
                        problem.position, problem.payload);
  [displacements(end + 1, :), taken] = timed(run, problem.repeats);
  times = [times, taken];
end
answer = struct("version", OCTAVE_VERSION, "solver", [args{2} ", forward differences"], ...
                "direct_us", median(direct_times), "direct_position", loaded(1:3), ...
                "observation_us", median(times), "displacements", displacements);
disp(jsonencode(answer));
