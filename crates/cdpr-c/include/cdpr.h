/* libcdpr: elasto-statics of cable-driven parallel robots. SI units throughout; docs/c.md explains the use.
 *
 * Any number of threads at a time may call the functions that take a robot or no handle. A tracker or a path belongs
 * to one thread at a time. */

#ifndef CDPR_H
#define CDPR_H

/* Made by cbindgen of crates/cdpr-c/src: do not edit. */

#include <stddef.h>
#include <stdint.h>

/**
 * How a call has ended.
 */
typedef enum CdprStatus {
    /**
     * The results are written.
     */
    CDPR_STATUS_OK = 0,
    /**
     * A pointer is null or not aligned.
     */
    CDPR_STATUS_POINTER = 1,
    /**
     * The number of values is not that of the robot's cables or inputs.
     */
    CDPR_STATUS_SIZE = 2,
    /**
     * A value is NaN, infinite or out of its range.
     */
    CDPR_STATUS_INVALID = 3,
    /**
     * The text is not a robot, or no robot of the library has this name.
     */
    CDPR_STATUS_ROBOT = 4,
    /**
     * The function does not take this kind of robot.
     */
    CDPR_STATUS_UNSUPPORTED = 5,
    /**
     * There is no result: the pose is infeasible, a cable is overstrained, or a derivative does not exist.
     */
    CDPR_STATUS_NO_SOLUTION = 6,
    /**
     * The equilibrium is unstable or is lost on the way to the load.
     */
    CDPR_STATUS_UNSTABLE = 7,
    /**
     * The iterations did not converge. A tracker keeps its last state.
     */
    CDPR_STATUS_NOT_CONVERGED = 8,
    /**
     * A fault of the library. Free the handle of the call, and report the message.
     */
    CDPR_STATUS_PANIC = 9,
} CdprStatus;

/**
 * Lengths and tensions along a path of poses: the handle of `cdpr_path_new`. One thread at a time may use
 * it.
 */
typedef struct CdprPath CdprPath;

/**
 * A robot: the handle of `cdpr_robot_named` and `cdpr_robot_from_json`. It does not change, and any number
 * of threads may use it. Trackers and paths remain valid when it is freed.
 */
typedef struct CdprRobot CdprRobot;

/**
 * Follows the pose of the platform while lengths and load change: the handle of `cdpr_tracker_new`. One
 * thread at a time may use it.
 */
typedef struct CdprTracker CdprTracker;

/**
 * Pose of the platform in the base frame.
 */
typedef struct CdprPose {
    /**
     * Position of the reference point P [m].
     */
    double position[3];
    /**
     * Rotation as a unit quaternion (w, x, y, z); (1, 0, 0, 0) where the platform is level.
     */
    double quaternion[4];
} CdprPose;

/**
 * Load on the platform in addition to its own weight.
 */
typedef struct CdprLoad {
    /**
     * Mass added at the platform's centre of mass [kg].
     */
    double payload;
    /**
     * Force in the base frame [N].
     */
    double force[3];
    /**
     * Moment about P in the base frame [N m].
     */
    double moment[3];
} CdprLoad;

/**
 * Where a call reads or writes a value of each cable.
 */
typedef struct CdprCables {
    /**
     * Number of values of each list: that of the cables.
     */
    size_t count;
    /**
     * Unstrained lengths [m].
     */
    double *lengths;
    /**
     * Tensions at the platform [N]. They are not written where this is null.
     */
    double *tensions;
} CdprCables;

/**
 * How exact a result is and how it was found.
 */
typedef struct CdprReport {
    /**
     * Largest distance between the end of a cable and its anchor point [m].
     */
    double closure;
    /**
     * Unbalanced force on the platform [N].
     */
    double force;
    /**
     * Unbalanced moment about P [N m].
     */
    double moment;
    /**
     * Iterations that were made.
     */
    uint32_t iterations;
    /**
     * 1 where a path has left its branch, so that its lengths may jump, else 0.
     */
    uint32_t jump;
} CdprReport;

/**
 * Motion of the platform in the base frame.
 */
typedef struct CdprMotion {
    /**
     * Displacement of P [m].
     */
    double translation[3];
    /**
     * Rotation vector [rad].
     */
    double rotation[3];
} CdprMotion;

/**
 * Stiffness of the platform at a pose.
 */
typedef struct CdprStiffness {
    /**
     * Matrix of (dp, dphi) [N/m, N/rad, N, N m/rad], row by row.
     */
    double matrix[6][6];
    /**
     * Stiffness of the softest motion [N/m].
     */
    double least;
    /**
     * 1 where the equilibrium is stable, else 0.
     */
    uint32_t is_stable;
} CdprStiffness;

/**
 * Where derivatives are written, row by row with a column for each input, per SI unit of the input.
 *
 * The inputs are the parameters of the robot, the payload and the six coordinates of the pose. A matrix
 * whose pointer is null is not written. Where the derivatives on both sides differ, because a tension is at
 * its limit, it is that for a decreasing input.
 */
typedef struct CdprDerivatives {
    /**
     * Number of columns: that of `cdpr_robot_inputs`.
     */
    size_t inputs;
    /**
     * Unstrained lengths, a row for each cable [m per unit].
     */
    double *lengths;
    /**
     * Tensions that set the lengths, a row for each cable [N per unit].
     */
    double *tensions;
    /**
     * Displacement under the load, three rows [m per unit].
     */
    double *displacement;
    /**
     * Norm of the displacement, one row [m per unit].
     */
    double *magnitude;
} CdprDerivatives;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The version of the library.
 */
const char *cdpr_version(void);

/**
 * The message of the last call of this thread that did not return CDPR_STATUS_OK; it is empty before the
 * first one. It is valid until the next such call of this thread.
 */
const char *cdpr_message(void);

/**
 * Creates the robot of the library with this name, such as "caroca".
 *
 * Where a function that creates a handle fails, the handle is null.
 */
enum CdprStatus cdpr_robot_named(const char *name, struct CdprRobot **robot);

/**
 * Creates the robot of a file cdpr-robot/1, whose text has `size` bytes.
 */
enum CdprStatus cdpr_robot_from_json(const char *text, size_t size, struct CdprRobot **robot);

/**
 * Frees a robot; null is ignored.
 */
void cdpr_robot_free(struct CdprRobot *robot);

/**
 * The number of cables; 0 for null.
 */
size_t cdpr_robot_cables(const struct CdprRobot *robot);

/**
 * The number of inputs by which derivatives are taken: the parameters, the payload and the six coordinates
 * of the pose; 0 for null.
 */
size_t cdpr_robot_inputs(const struct CdprRobot *robot);

/**
 * The name of an input, from 0, such as "mass" or "b1.z"; null beyond the last one. It is valid until the
 * robot is freed.
 */
const char *cdpr_robot_input(const struct CdprRobot *robot, size_t index);

/**
 * Writes the unstrained lengths and the tensions that hold a pose under the platform's weight and `load`.
 *
 * `load` may be null for none, and `report` where it is not wanted, here and below.
 */
enum CdprStatus cdpr_inverse(const struct CdprRobot *robot,
                             const struct CdprPose *pose,
                             const struct CdprLoad *load,
                             const struct CdprCables *cables,
                             struct CdprReport *report);

/**
 * Writes the pose and the tensions of the equilibrium for `cables.lengths` near `pose`, or to which the
 * platform descends from it: the result overwrites `pose`.
 */
enum CdprStatus cdpr_direct(const struct CdprRobot *robot,
                            const struct CdprCables *cables,
                            const struct CdprLoad *load,
                            struct CdprPose *pose,
                            struct CdprReport *report);

/**
 * Writes the motion of the platform under `load`, with the lengths that hold `pose` without it.
 */
enum CdprStatus cdpr_deflection(const struct CdprRobot *robot,
                                const struct CdprPose *pose,
                                const struct CdprLoad *load,
                                struct CdprMotion *motion,
                                struct CdprReport *report);

/**
 * Writes the stiffness at a pose that the inverse model holds under the platform's weight and `load`.
 */
enum CdprStatus cdpr_stiffness(const struct CdprRobot *robot,
                               const struct CdprPose *pose,
                               const struct CdprLoad *load,
                               struct CdprStiffness *result,
                               struct CdprReport *report);

/**
 * Writes the derivatives of lengths, tensions and deflection by all inputs.
 */
enum CdprStatus cdpr_derivatives(const struct CdprRobot *robot,
                                 const struct CdprPose *pose,
                                 const struct CdprLoad *load,
                                 const struct CdprDerivatives *result,
                                 struct CdprReport *report);

/**
 * Creates a tracker at the equilibrium for these lengths and this load near `start`, or to which the platform
 * descends from it.
 */
enum CdprStatus cdpr_tracker_new(const struct CdprRobot *robot,
                                 const double *lengths,
                                 size_t count,
                                 const struct CdprLoad *load,
                                 const struct CdprPose *start,
                                 struct CdprTracker **tracker);

/**
 * Goes to the equilibrium for other lengths and another load, in at most 12 iterations.
 *
 * Nothing is allocated for up to 16 cables without pulleys and leads (4 on x86-64 without AVX2). Where the
 * iterations do not converge, the last state is kept, and `report` has its residuals with the number of
 * iterations made.
 */
enum CdprStatus cdpr_tracker_step(struct CdprTracker *tracker,
                                  const double *lengths,
                                  size_t count,
                                  const struct CdprLoad *load,
                                  struct CdprReport *report);

/**
 * Writes the pose of the tracker and, where `tensions` is not null, the tensions at the platform.
 */
enum CdprStatus cdpr_tracker_state(const struct CdprTracker *tracker,
                                   struct CdprPose *pose,
                                   double *tensions,
                                   size_t count);

/**
 * Frees a tracker; null is ignored.
 */
void cdpr_tracker_free(struct CdprTracker *tracker);

/**
 * Creates a path, whose first pose is the next one.
 */
enum CdprStatus cdpr_path_new(const struct CdprRobot *robot, struct CdprPath **path);

/**
 * Writes lengths and tensions at the next pose of a path, on the branch of the last ones.
 *
 * Where the branch ends, `report.jump` is 1. After a failure the path continues from the last pose with a
 * solution.
 */
enum CdprStatus cdpr_path_next(struct CdprPath *path,
                               const struct CdprPose *pose,
                               const struct CdprLoad *load,
                               const struct CdprCables *cables,
                               struct CdprReport *report);

/**
 * Frees a path; null is ignored.
 */
void cdpr_path_free(struct CdprPath *path);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* CDPR_H */
