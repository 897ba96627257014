classdef Robot < handle
    % A cable-driven parallel robot: its lengths, tensions, poses, deflections and derivatives.
    %
    %   robot = cdpr.Robot('caroca')       a robot of the library
    %   robot = cdpr.Robot('my.json')      a robot file, cdpr-robot/1
    %   robot = cdpr.Robot(jsonencode(s))  the text of one, here of a struct
    %
    % A pose is [x y z] or [x y z qw qx qy qz]. A load is [], a payload [kg] or
    % [payload fx fy fz mx my mz] [kg, N, N m]. SI units throughout. A report is
    % [closure force moment iterations]: the residuals [m, N, N m] of the result.
    properties (SetAccess = private)
        id = 0; % number of the handle in cdpr_mex
    end
    methods
        function self = Robot(name)
            if numel(name) > 0 && name(1) == '{'
                self.id = cdpr_mex('robot_json', name);
            elseif numel(name) > 5 && strcmp(name(end - 4:end), '.json')
                self.id = cdpr_mex('robot_json', fileread(name));
            else
                self.id = cdpr_mex('robot_named', name);
            end
        end
        function delete(self)
            if self.id > 0
                cdpr_mex('robot_free', self.id);
                self.id = 0;
            end
        end
        function n = cables(self)
            n = cdpr_mex('cables', self.id);
        end
        function names = inputs(self)
            % Names of the columns of all derivatives.
            names = cdpr_mex('inputs', self.id);
        end
        function [lengths, tensions, report] = inverse(self, pose, load)
            if nargin < 3, load = []; end
            [lengths, tensions, report] = cdpr_mex('inverse', self.id, pose, load);
        end
        function [pose, tensions, report] = direct(self, lengths, start, load)
            % The pose for unstrained lengths, searched from a pose.
            if nargin < 4, load = []; end
            [pose, tensions, report] = cdpr_mex('direct', self.id, start, load, lengths);
        end
        function [displacement, rotation, report] = deflection(self, pose, load)
            if nargin < 3, load = []; end
            [displacement, rotation, report] = cdpr_mex('deflection', self.id, pose, load);
        end
        function [matrix, least, report] = stiffness(self, pose, load)
            if nargin < 3, load = []; end
            [matrix, least, report] = cdpr_mex('stiffness', self.id, pose, load);
        end
        function [matrices, report] = derivatives(self, pose, load)
            % Derivatives of lengths, tensions, displacement and its magnitude: the fields of a struct, each
            % a matrix with a column for each of inputs(). The columns x, y, z and rx, ry, rz of lengths are
            % the Jacobian of the winches. Without a load the magnitude has no derivatives: they are NaN.
            if nargin < 3, load = []; end
            [matrices, report] = cdpr_mex('derivatives', self.id, pose, load);
        end
    end
end
