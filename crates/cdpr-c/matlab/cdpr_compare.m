function rows = cdpr_compare(folder, file)
    % The direct model by libcdpr, lsqnonlin and fsolve in one run: same answers, and how many times as fast.
    %
    %   cdpr_compare(FOLDER)           with the robot files caroca.json, cogiro.json, .. in FOLDER
    %   cdpr_compare(FOLDER, 'out.md') writes the table to a file, too
    %
    % Each robot carries a twentieth of its mass, with the lengths that hold a pose without it. The solvers
    % begin at this pose with straight cables and use differences. lsqnonlin is of the optimization toolbox,
    % or of Octave's package optim; it is left out where it is missing. Times are those of the processor,
    % means of many calls [us]. A solver may find a root at which a cable pushes: no equilibrium.
    robots = {'caroca', [0.25 -0.125 1.75]; 'cogiro', [0.5 -0.25 1.75]; 'fast', [2 1 140];
              'ipanema-1', [0.125 0.0625 1]}; % poses [m]
    is_octave = exist('OCTAVE_VERSION', 'builtin') > 0;
    warning('off', 'Octave:shadowed-function');
    if is_octave, try, pkg('load', 'optim'); catch, end, end
    if is_octave, name = ['Octave ' version()]; else, name = ['MATLAB ' version()]; end
    rows = cell(0, 6);
    for k = 1:size(robots, 1)
        rows = [rows; compared(folder, robots{k, :})]; %#ok<AGROW>
    end
    text = sprintf(['%s, one thread\n\n' ...
                    '| robot | program | time [us] | ratio | apart [mm] | cables that push |\n' ...
                    '|---|---|---|---|---|---|\n'], name);
    for k = 1:size(rows, 1)
        text = [text sprintf('| %s | %s | %.3g | %.3g | %.1e | %d |\n', rows{k, :})]; %#ok<AGROW>
    end
    fprintf('%s', text);
    if nargin > 1
        id = fopen(file, 'w'); fprintf(id, '%s', text); fclose(id);
    end
end

function rows = compared(folder, name, at)
    robot = cdpr.Robot(fullfile(folder, [name '.json']));
    model = model_of(jsondecode(fileread(fullfile(folder, [name '.json']))));
    payload = 0.05 * model.mass;
    [lengths, tensions] = robot.inverse(at);
    tracker = cdpr.Tracker(robot, lengths, at);
    loads = [payload 0]; % The tracker goes there and back, and ends there.
    steps = 5001; begin = cputime();
    for k = 1:steps
        tracked = tracker.step(lengths, loads(2 - mod(k, 2)));
    end
    step = 1e6 * (cputime() - begin) / steps;
    [pose, time] = timed(@() robot.direct(lengths, at, payload), 5000);
    rows = {name, 'libcdpr, `tracker.step`', step, 1, 1e3 * norm(tracked(1:3) - pose(1:3)), 0;
            name, 'libcdpr, `robot.direct`', time, 0, 0, 0};
    options = optimset('TolFun', 1e-12, 'TolX', 1e-10, 'Display', 'off', 'MaxIter', 400);
    open = @(x) residual(model, x, lengths, payload);
    start = start_of(model, at(:), tensions);
    solvers = {'lsqnonlin', @() lsqnonlin(open, start, [], [], options);
               'fsolve', @() fsolve(open, start, options)};
    for k = 1:2
        if exist(solvers{k, 1}, 'file')
            [found, time] = timed(solvers{k, 2}, 3);
            apart = 1e3 * norm(found(1:3)' - pose(1:3));
            pushing = sum(found(7:2:end) < 0);
            rows = [rows; {name, ['`' solvers{k, 1} '`'], time, 0, apart, pushing}]; %#ok<AGROW>
        end
    end
    for k = 1:size(rows, 1), rows{k, 4} = rows{k, 3} / rows{1, 3}; end
end

function [found, time] = timed(solve, repeats)
    found = solve(); % The first call is not timed.
    begin = cputime();
    for k = 1:repeats
        solve();
    end
    time = 1e6 * (cputime() - begin) / repeats;
end

function model = model_of(file)
    model.mass = file.platform.mass;
    model.center = file.platform.center_of_mass(:);
    model.gravity = file.gravity;
    model.w = file.gravity * file.cable.linear_density;
    model.ea = file.cable.section * file.cable.youngs_modulus;
    model.a = [file.cables.anchor_point];
    model.b = [file.cables.exit_point];
end

function x = start_of(model, position, tensions)
    r = position + model.a - model.b;
    distance = sqrt(sum(r.^2, 1));
    forces = tensions ./ distance .* [sqrt(sum(r(1:2, :).^2, 1)); r(3, :)];
    x = [position; 0; 0; 0; forces(:)];
end

% Equations (1) to (3) of the paper: unknowns are the position, the rotation vector and the force (fx, fz) on
% each cable at its anchor point; rows are in N, N m and mm.
function open = residual(model, x, lengths, payload)
    v = x(4:6); k = [0 -v(3) v(2); v(3) 0 -v(1); -v(2) v(1) 0]; angle = norm(v) + realmin;
    arms = (eye(3) + sin(angle) / angle * k + 2 * (sin(angle / 2) / angle)^2 * k * k) ...
        * [model.a model.center];
    center = arms(:, end); arms = arms(:, 1:end-1);
    r = x(1:3) + arms - model.b;
    h = sqrt(sum(r(1:2, :).^2, 1));
    f = reshape(x(7:end), 2, []);
    below = f(2, :) - model.w * lengths;
    xc = f(1, :) .* lengths / model.ea ...
        + f(1, :) / model.w .* (asinh(f(2, :) ./ f(1, :)) - asinh(below ./ f(1, :)));
    zc = f(2, :) .* lengths / model.ea - model.w * lengths.^2 / (2 * model.ea) ...
        + (sqrt(sum(f.^2, 1)) - sqrt(f(1, :).^2 + below.^2)) / model.w;
    pulls = -[f(1, :) .* r(1:2, :) ./ h; f(2, :)];
    weight = [0; 0; -(model.mass + payload) * model.gravity];
    moment = sum(cross(arms, pulls), 2) + cross(center, weight);
    open = [sum(pulls, 2) + weight; moment; 1e3 * (h - xc)'; 1e3 * (r(3, :) - zc)'];
end
