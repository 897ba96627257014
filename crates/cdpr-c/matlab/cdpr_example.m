% CAROCA of the paper: lengths, deflection, what changes it most, and a platform that is followed.
robot = cdpr.Robot('caroca');
pose = [0 0 1.75];
[lengths, tensions] = robot.inverse(pose);
fprintf('l1 = %.6f m, t1 = %.3f N\n', lengths(1), tensions(1));
displacement = robot.deflection(pose, 50);
fprintf('%.5f mm under 50 kg\n', 1e3 * norm(displacement));
found = robot.derivatives(pose, 50);
names = robot.inputs();
fprintf('%.5f mm per GPa\n', 1e12 * found.magnitude(strcmp(names, 'youngs_modulus')));
tracker = cdpr.Tracker(robot, lengths, pose, 50);
for k = 1:100
    lengths(1) = lengths(1) - 1e-5; % a winch that reels in
    [pose, tensions, report, converged] = tracker.step(lengths, 50);
end
fprintf('z = %.6f m, t1 = %.3f N, residual below 1e-8 N: %d\n', pose(3), tensions(1), report(2) < 1e-8 && converged);
delete(tracker); delete(robot);
