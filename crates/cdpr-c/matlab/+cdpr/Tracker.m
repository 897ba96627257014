classdef Tracker < handle
    % Follows the pose of a robot while its lengths and its load change, as in a control loop.
    %
    %   tracker = cdpr.Tracker(robot, lengths, start, load)
    %   [pose, tensions, report, converged] = tracker.step(lengths, load)
    %
    %   points = tracker.shape(cable, count)
    %
    % Where a step does not converge in 12 iterations, the last pose is kept and `converged` is false.
    properties (SetAccess = private)
        id = 0; % number of the handle in cdpr_mex
    end
    methods
        function self = Tracker(robot, lengths, start, load)
            if nargin < 4, load = []; end
            self.id = cdpr_mex('tracker_new', robot.id, start, load, lengths);
        end
        function delete(self)
            if self.id > 0
                cdpr_mex('tracker_free', self.id);
                self.id = 0;
            end
        end
        function [pose, tensions, report, converged] = step(self, lengths, load)
            if nargin < 3, load = []; end
            [pose, tensions, report, converged] = cdpr_mex('tracker_step', self.id, lengths, load);
        end
        function points = shape(self, cable, count)
            % Points of a cable, from 1, as it hangs after the last step, in the base frame [m], a row for
            % each: from its exit point, or where it leaves its pulley, to the platform.
            points = cdpr_mex('tracker_shape', self.id, cable, count);
        end
    end
end
