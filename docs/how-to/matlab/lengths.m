% Lengths of CAROCA along a line: a table goes out, a line of JSON for each pose comes back.
if ~exist('cdpr', 'var'), cdpr = 'cdpr'; end % the program; its path where the shell does not find it
poses = [linspace(-2, 4, 4)', zeros(4, 1), 1.75 * ones(4, 1)]; % [m], a pose a row
file = [tempname '.csv'];
id = fopen(file, 'w');
fprintf(id, 'x_m,y_m,z_m\n'); fprintf(id, '%.17g,%.17g,%.17g\n', poses'); fclose(id);
[status, text] = system([cdpr ' inverse caroca --quiet --format json --poses ' file]);
if status ~= 0 && status ~= 3, error('cdpr ended with %d: %s', status, text); end % 3: a pose without an answer
lines = strsplit(strtrim(text), char(10));
lines = lines(strncmp(lines, '{', 1)); % without what the program says to the user
for k = 1:numel(lines)
    answer = jsondecode(lines{k});
    if isfield(answer, 'error')
        fprintf('x = %4.1f m: %s\n', poses(k, 1), answer.error.kind);
    else
        fprintf('x = %4.1f m: l1 = %.4f m, t1 = %.1f N\n', poses(k, 1), answer.lengths(1), answer.tensions(1));
    end
end
