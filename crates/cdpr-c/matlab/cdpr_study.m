function deflection = cdpr_study(file, observations)
    % The study of Baklouti, Caro, Courteille (CableCon 2017), Fig. 4a to 5c: cdpr_study('caroca.json', 2000)
    rand('twister', 2017); %#ok<RAND>
    errors = @(half, step, varargin) step * round(half * (2 * rand(varargin{:}) - 1) / step); % Table 3
    nominal = jsondecode(fileread(file));
    robot = cdpr.Robot(file); names = robot.inputs(); pose = [0 0 1.75]; slopes = robot.derivatives(pose, 50);
    deflection = slopes.magnitude(strncmp(names, 'dt', 2)) * errors(15, 0.1, 8, observations); % first order
    for k = 1:observations
        one = nominal;
        one.platform.mass = one.platform.mass + errors(18, 0.05, 1);
        one.platform.center_of_mass = one.platform.center_of_mass + errors(0.015, 6e-4, 3, 1);
        one.cable.linear_density = one.cable.linear_density + errors(0.01015, 3e-5, 1);
        one.cable.youngs_modulus = one.cable.youngs_modulus + errors(18e9, 5e7, 1);
        for i = 1:8
            one.cables(i).anchor_point = one.cables(i).anchor_point + errors(0.015, 6e-4, 3, 1);
            one.cables(i).exit_point = one.cables(i).exit_point + errors(0.03, 1.2e-3, 3, 1);
        end
        deflection(k) = deflection(k) + norm(cdpr.Robot(jsonencode(one)).deflection(pose, 50));
    end
    fprintf('%.2f mm, from %.2f mm to %.2f mm\n', 1e3 * [mean(deflection) min(deflection) max(deflection)]);
    slopes = robot.derivatives([3.2 1.7 3], 50); % the other pose
    for point = 'ab'
        effect = @(i) norm(slopes.magnitude(strncmp(names, sprintf('%s%d.', point, i), 3)));
        [~, order] = sort(arrayfun(effect, 1:8), 'descend');
        fprintf('largest effects: %s%d, %s%d\n', point, order(1), point, order(2));
    end
end
