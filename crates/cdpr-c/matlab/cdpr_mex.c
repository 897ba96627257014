/* Gateway of libcdpr for MATLAB and Octave: cdpr_mex(COMMAND, HANDLE, ..). The classes of +cdpr call it.
 *
 * A pose is [x y z] or [x y z qw qx qy qz], a load is [], a payload or [payload fx fy fz mx my mz]. */
#include "mex.h"
#include <cdpr.h>
#include <stdlib.h>
#include <string.h>

enum { ROBOT = 1, TRACKER = 2, MOST = 1024 };

/* Live handles; those that MATLAB has are their numbers here, so that a wrong one is refused. */
static struct {
    int kind;
    void *pointer;
} live[MOST];

static void need(CdprStatus status)
{
    static const char *const names[] = {"ok",        "pointer", "size",     "invalid", "robot", "unsupported",
                                        "noSolution", "unstable", "notConverged", "panic"};
    char identifier[32] = "cdpr:";
    if (status != CDPR_STATUS_OK) {
        strcat(identifier, names[status]);
        mexErrMsgIdAndTxt(identifier, "%s", cdpr_message());
    }
}

static void refuse(const char *what)
{
    mexErrMsgIdAndTxt("cdpr:invalid", "%s", what);
}

static int is_none(const CdprLoad *load)
{
    const double *f = load->force, *m = load->moment;
    return load->payload == 0.0 && f[0] == 0.0 && f[1] == 0.0 && f[2] == 0.0 && m[0] == 0.0 && m[1] == 0.0 && m[2] == 0.0;
}

static mxArray *new_handle(int kind, void *pointer)
{
    int i;
    for (i = 0; i < MOST; i++) {
        if (live[i].kind == 0) {
            live[i].kind = kind;
            live[i].pointer = pointer;
            mexLock();
            return mxCreateDoubleScalar(i + 1);
        }
    }
    if (kind == ROBOT) {
        cdpr_robot_free((CdprRobot *)pointer);
    } else {
        cdpr_tracker_free((CdprTracker *)pointer);
    }
    refuse("too many robots and trackers: delete some");
    return NULL;
}

static int number_of(const mxArray *array, int kind)
{
    const double value = mxIsDouble(array) && mxGetNumberOfElements(array) == 1 ? mxGetScalar(array) : 0.0;
    const int i = value >= 1.0 && value <= MOST ? (int)value - 1 : -1;
    if (i < 0 || live[i].kind != kind) {
        refuse("no robot or tracker: it was deleted or never created");
    }
    return i;
}

static const CdprRobot *robot_of(const mxArray *array)
{
    return (const CdprRobot *)live[number_of(array, ROBOT)].pointer;
}

static CdprTracker *tracker_of(const mxArray *array)
{
    return (CdprTracker *)live[number_of(array, TRACKER)].pointer;
}

static void destroy(const mxArray *array, int kind)
{
    const int i = number_of(array, kind);
    if (kind == ROBOT) {
        cdpr_robot_free((CdprRobot *)live[i].pointer);
    } else {
        cdpr_tracker_free((CdprTracker *)live[i].pointer);
    }
    live[i].kind = 0;
    mexUnlock();
}

static const double *doubles(const mxArray *array, const char *refusal)
{
    if (!mxIsDouble(array) || mxIsComplex(array) || mxIsSparse(array)) {
        refuse(refusal);
    }
    return mxGetPr(array);
}

static CdprPose pose_of(const mxArray *array)
{
    static const char expected[] = "a pose is [x y z] or [x y z qw qx qy qz]";
    const double *values = doubles(array, expected);
    const size_t count = mxGetNumberOfElements(array);
    CdprPose pose = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    if (count != 3 && count != 7) {
        refuse(expected);
    }
    memcpy(pose.position, values, sizeof pose.position);
    if (count == 7) {
        memcpy(pose.quaternion, values + 3, sizeof pose.quaternion);
    }
    return pose;
}

static CdprLoad load_of(const mxArray *array)
{
    static const char expected[] = "a load is [], a payload or [payload fx fy fz mx my mz]";
    const size_t count = mxGetNumberOfElements(array);
    const double *values = doubles(array, expected);
    CdprLoad load = {0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    if (count != 0 && count != 1 && count != 7) {
        refuse(expected);
    }
    if (count > 0) {
        load.payload = values[0];
    }
    if (count == 7) {
        memcpy(load.force, values + 1, sizeof load.force);
        memcpy(load.moment, values + 4, sizeof load.moment);
    }
    return load;
}

static mxArray *row(const double *values, size_t count)
{
    mxArray *array = mxCreateDoubleMatrix(1, count, mxREAL);
    memcpy(mxGetPr(array), values, count * sizeof *values);
    return array;
}

static mxArray *pose_row(const CdprPose *pose)
{
    double values[7];
    memcpy(values, pose->position, sizeof pose->position);
    memcpy(values + 3, pose->quaternion, sizeof pose->quaternion);
    return row(values, 7);
}

/* closure [m], force [N], moment [N m], iterations */
static mxArray *report_row(const CdprReport *report)
{
    const double values[4] = {report->closure, report->force, report->moment, (double)report->iterations};
    return row(values, 4);
}

/* A matrix of which `values` has the rows one after the other. */
static mxArray *matrix(const double *values, size_t rows, size_t columns)
{
    mxArray *array = mxCreateDoubleMatrix(rows, columns, mxREAL);
    double *to = mxGetPr(array);
    size_t i, k;
    for (i = 0; i < rows; i++) {
        for (k = 0; k < columns; k++) {
            to[k * rows + i] = values[i * columns + k];
        }
    }
    return array;
}

static void create_robot(int is_name, const mxArray *array, mxArray **results)
{
    char *text = mxIsChar(array) ? mxArrayToString(array) : NULL;
    CdprRobot *robot = NULL;
    CdprStatus status;
    if (text == NULL) {
        refuse("a robot is a name of the library or the text of a file");
    }
    status = is_name ? cdpr_robot_named(text, &robot) : cdpr_robot_from_json(text, strlen(text), &robot);
    mxFree(text);
    need(status);
    results[0] = new_handle(ROBOT, robot);
}

static void names(const CdprRobot *robot, mxArray **results)
{
    const size_t count = cdpr_robot_inputs(robot);
    size_t i;
    results[0] = mxCreateCellMatrix(1, count);
    for (i = 0; i < count; i++) {
        mxSetCell(results[0], i, mxCreateString(cdpr_robot_input(robot, i)));
    }
}

static void inverse(const CdprRobot *robot, const CdprPose *pose, const CdprLoad *load, mxArray **results)
{
    const size_t n = cdpr_robot_cables(robot);
    CdprCables cables;
    CdprReport report;
    results[0] = mxCreateDoubleMatrix(1, n, mxREAL);
    results[1] = mxCreateDoubleMatrix(1, n, mxREAL);
    cables.count = n;
    cables.lengths = mxGetPr(results[0]);
    cables.tensions = mxGetPr(results[1]);
    need(cdpr_inverse(robot, pose, load, &cables, &report));
    results[2] = report_row(&report);
}

static void direct(const CdprRobot *robot, CdprPose pose, const CdprLoad *load, const mxArray *lengths,
                   mxArray **results)
{
    CdprCables cables;
    CdprReport report;
    mxArray *given = mxDuplicateArray(lengths);
    cables.lengths = (double *)doubles(given, "lengths are numbers");
    cables.count = mxGetNumberOfElements(given);
    results[1] = mxCreateDoubleMatrix(1, cables.count, mxREAL);
    cables.tensions = mxGetPr(results[1]);
    need(cdpr_direct(robot, &cables, load, &pose, &report));
    mxDestroyArray(given);
    results[0] = pose_row(&pose);
    results[2] = report_row(&report);
}

static void deflection(const CdprRobot *robot, const CdprPose *pose, const CdprLoad *load, mxArray **results)
{
    CdprMotion motion;
    CdprReport report;
    need(cdpr_deflection(robot, pose, load, &motion, &report));
    results[0] = row(motion.translation, 3);
    results[1] = row(motion.rotation, 3);
    results[2] = report_row(&report);
}

static void stiffness(const CdprRobot *robot, const CdprPose *pose, const CdprLoad *load, mxArray **results)
{
    CdprStiffness found;
    CdprReport report;
    need(cdpr_stiffness(robot, pose, load, &found, &report));
    results[0] = matrix(&found.matrix[0][0], 6, 6);
    results[1] = mxCreateDoubleScalar(found.least);
    results[2] = report_row(&report);
}

/* Without a load nothing is displaced, and the magnitude of that has no derivatives: they are NaN. */
static void derivatives(const CdprRobot *robot, const CdprPose *pose, const CdprLoad *load, mxArray **results)
{
    static const char *fields[] = {"lengths", "tensions", "displacement", "magnitude"};
    const size_t n = cdpr_robot_cables(robot), inputs = cdpr_robot_inputs(robot);
    const size_t rows[4] = {n, n, 3, 1};
    double *values[4];
    CdprDerivatives found;
    CdprReport report;
    size_t k;
    int i;
    for (i = 0; i < 4; i++) {
        values[i] = (double *)mxCalloc(rows[i] * inputs, sizeof(double));
    }
    found.inputs = inputs;
    found.lengths = values[0];
    found.tensions = values[1];
    found.displacement = values[2];
    found.magnitude = is_none(load) ? NULL : values[3];
    for (k = 0; is_none(load) && k < inputs; k++) {
        values[3][k] = mxGetNaN();
    }
    need(cdpr_derivatives(robot, pose, load, &found, &report));
    results[0] = mxCreateStructMatrix(1, 1, 4, fields);
    for (i = 0; i < 4; i++) {
        mxSetField(results[0], 0, fields[i], matrix(values[i], rows[i], inputs));
        mxFree(values[i]);
    }
    results[1] = report_row(&report);
}

static void tracker_new(const CdprRobot *robot, const CdprPose *pose, const CdprLoad *load,
                        const mxArray *lengths, mxArray **results)
{
    CdprTracker *tracker = NULL;
    const double *values = doubles(lengths, "lengths are numbers");
    need(cdpr_tracker_new(robot, values, mxGetNumberOfElements(lengths), load, pose, &tracker));
    results[0] = new_handle(TRACKER, tracker);
}

/* Results: pose, tensions, report, and 1 where the step converged. */
static void tracker_step(CdprTracker *tracker, const mxArray *lengths, const CdprLoad *load, mxArray **results)
{
    const double *values = doubles(lengths, "lengths are numbers");
    const size_t count = mxGetNumberOfElements(lengths);
    CdprPose pose;
    CdprReport report;
    const CdprStatus status = cdpr_tracker_step(tracker, values, count, load, &report);
    if (status != CDPR_STATUS_NOT_CONVERGED) {
        need(status);
    }
    results[1] = mxCreateDoubleMatrix(1, count, mxREAL);
    need(cdpr_tracker_state(tracker, &pose, mxGetPr(results[1]), count));
    results[0] = pose_row(&pose);
    results[2] = report_row(&report);
    results[3] = mxCreateLogicalScalar(status == CDPR_STATUS_OK);
}

/* Points of a cable, from 1, a row for each. */
static void tracker_shape(const CdprTracker *tracker, const mxArray *cable, const mxArray *points,
                          mxArray **results)
{
    static const char expected[] = "the number of a cable, from 1, and 2 to 1000 points are needed";
    const double *const cables = doubles(cable, expected), *const counts = doubles(points, expected);
    const int given = mxGetNumberOfElements(cable) == 1 && mxGetNumberOfElements(points) == 1;
    const double index = given ? cables[0] : 0.0, count = given ? counts[0] : 0.0;
    double *values;
    if (!(index >= 1.0) || index > 1e6 || !(count >= 2.0) || count > 1000.0) {
        refuse(expected);
    }
    values = (double *)mxCalloc(3 * (size_t)count, sizeof(double));
    need(cdpr_tracker_shape(tracker, (size_t)index - 1, values, (size_t)count));
    results[0] = matrix(values, (size_t)count, 3);
    mxFree(values);
}

/* Commands of a robot at a pose under a load. */
static int at_pose(const char *command, const CdprRobot *robot, int count, const mxArray **in,
                   mxArray **results)
{
    const int takes_lengths = strcmp(command, "direct") == 0 || strcmp(command, "tracker_new") == 0;
    CdprPose pose;
    CdprLoad load;
    if (count != (takes_lengths ? 3 : 2)) {
        refuse("a pose and a load are needed, and lengths where the pose is looked for");
    }
    pose = pose_of(in[0]);
    load = load_of(in[1]);
    if (strcmp(command, "inverse") == 0) {
        inverse(robot, &pose, &load, results);
    } else if (strcmp(command, "direct") == 0) {
        direct(robot, pose, &load, in[2], results);
    } else if (strcmp(command, "deflection") == 0) {
        deflection(robot, &pose, &load, results);
    } else if (strcmp(command, "stiffness") == 0) {
        stiffness(robot, &pose, &load, results);
    } else if (strcmp(command, "derivatives") == 0) {
        derivatives(robot, &pose, &load, results);
    } else if (strcmp(command, "tracker_new") == 0) {
        tracker_new(robot, &pose, &load, in[2], results);
    } else {
        return 0;
    }
    return 1;
}

void mexFunction(int wanted, mxArray *out[], int count, const mxArray *in[])
{
    mxArray *results[4] = {NULL, NULL, NULL, NULL};
    char command[32];
    int i;
    if (count < 2 || mxGetString(in[0], command, sizeof command) != 0) {
        refuse("a command and its arguments are needed: use cdpr.Robot and cdpr.Tracker");
    }
    if (strcmp(command, "robot_named") == 0 || strcmp(command, "robot_json") == 0) {
        create_robot(strcmp(command, "robot_named") == 0, in[1], results);
    } else if (strcmp(command, "robot_free") == 0) {
        destroy(in[1], ROBOT);
    } else if (strcmp(command, "tracker_free") == 0) {
        destroy(in[1], TRACKER);
    } else if (strcmp(command, "inputs") == 0) {
        names(robot_of(in[1]), results);
    } else if (strcmp(command, "cables") == 0) {
        results[0] = mxCreateDoubleScalar((double)cdpr_robot_cables(robot_of(in[1])));
    } else if (strcmp(command, "tracker_step") == 0 && count == 4) {
        const CdprLoad load = load_of(in[3]);
        tracker_step(tracker_of(in[1]), in[2], &load, results);
    } else if (strcmp(command, "tracker_shape") == 0 && count == 4) {
        tracker_shape(tracker_of(in[1]), in[2], in[3], results);
    } else if (!at_pose(command, robot_of(in[1]), count - 2, in + 2, results)) {
        refuse("no such command: use cdpr.Robot and cdpr.Tracker");
    }
    for (i = 0; i < 4; i++) {
        if (i < (wanted > 1 ? wanted : 1) && results[i] != NULL) {
            out[i] = results[i];
        }
    }
}
