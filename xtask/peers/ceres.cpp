// Direct model and one observation with Ceres: ceres PROBLEM.json [tiny], result as JSON on stdout.
//
// Unknowns of the direct model: p, rotation vector v with R = exp([v]), force (fx, fz) on every cable at its
// anchor point A_i. Equations, with r_i = p + R a_i - b_i, Eq. (1), h_i and z_i its horizontal length and
// height, e_i = (r_x/h, r_y/h):
//
//   sum F_i + m g = 0,  F_i = -(fx e_i, fz),  g = (0, 0, -9.81) m/s^2                  [N]     Eq. (3)
//   sum (R a_i) x F_i + (R c) x m g = 0                                                [N m]   Eq. (3)
//   h = fx L/EA + fx/w (asinh(fz/fx) - asinh((fz - w L)/fx))                           [mm]    Eq. (2a)
//   z = fz L/EA - w L^2/(2 EA) + (sqrt(fx^2 + fz^2) - sqrt(fx^2 + (fz - w L)^2))/w     [mm]    Eq. (2b)
//
// Inverse model: least-norm tensions t = -W^T (W W^T)^-1 w_ex, W from the directions of the cables at the
// platform; then for every cable the unknowns (angle, L) of Eq. (2a), (2b) with fx = t cos, fz = t sin;
// again, until the directions stop moving.
//
// Observation: inverse model of the robot with deviations, tension offsets dt, lengths for these, direct
// model without and with the payload, difference of the positions.
//
// Solver: ceres::Solve, Levenberg-Marquardt with dense Cholesky, or ceres::TinySolver (fixed sizes, no
// allocation) with LU of the normal equations; automatic derivatives.

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>
#include <time.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

using nlohmann::json;
template <int N>
using Vector = Eigen::Matrix<double, N, 1>;
using Vector8 = Vector<8>;

template <typename T>
T asinh_of(const T& u) {
  using std::log, std::sqrt;  // Jets of Ceres 2.1 have no asinh
  return log(u + sqrt(u * u + 1.0));
}

// End (x, z) of a cable: (2).
template <typename T, typename L>
void catenary(const T& fx, const T& fz, const L& length, double w, double ea, T& x, T& z) {
  using std::sqrt;
  const T v0 = fz - w * length;
  x = fx * length / ea + fx / w * (asinh_of(fz / fx) - asinh_of(v0 / fx));
  z = fz * length / ea - w * length * length / (2 * ea) +
      (sqrt(fx * fx + fz * fz) - sqrt(fx * fx + v0 * v0)) / w;
}

// Robot with the parameter vector: mass, density, modulus, a (24), b (24), centre of mass, dt (8).
struct Robot {
  double g, mass, w, ea;
  Eigen::Matrix<double, 3, 8> a, b;
  Vector<3> center;
  Vector8 dt;

  Robot(double gravity, double section, const Eigen::VectorXd& parameters)
      : g(gravity), mass(parameters[0]), w(parameters[1] * g), ea(parameters[2] * section) {
    a = Eigen::Map<const Eigen::Matrix<double, 3, 8>>(&parameters[3]);
    b = Eigen::Map<const Eigen::Matrix<double, 3, 8>>(&parameters[27]);
    center = parameters.segment<3>(51);
    dt = parameters.segment<8>(54);
  }
};

// The 22 equations.
struct Direct {
  enum { NUM_RESIDUALS = 22, NUM_PARAMETERS = 22 };
  const Robot& robot;
  const Vector8& lengths;
  double mass;

  template <typename T>
  bool operator()(const T* x, T* open) const {
    using std::sqrt;
    const double mg = -mass * robot.g;
    T rotation[9], center[3];
    ceres::AngleAxisToRotationMatrix(x + 3, rotation);
    rotated(rotation, robot.center, center);
    const T wrench[6] = {T(0), T(0), T(mg), center[1] * mg, -center[0] * mg, T(0)};
    for (int k = 0; k < 6; ++k) open[k] = -wrench[k];
    for (int i = 0; i < 8; ++i) {
      const T &fx = x[6 + 2 * i], &fz = x[7 + 2 * i];
      T arm[3], xc, zc;
      rotated(rotation, robot.a.col(i), arm);
      const T r[3] = {x[0] + arm[0] - robot.b(0, i), x[1] + arm[1] - robot.b(1, i),
                      x[2] + arm[2] - robot.b(2, i)};
      const T h = sqrt(r[0] * r[0] + r[1] * r[1]);
      const T f[3] = {fx * r[0] / h, fx * r[1] / h, fz};
      T moment[3];
      ceres::CrossProduct(arm, f, moment);
      for (int k = 0; k < 3; ++k) {
        open[k] += f[k];
        open[3 + k] += moment[k];
      }
      catenary(fx, fz, lengths[i], robot.w, robot.ea, xc, zc);
      open[6 + 2 * i] = 1e3 * (h - xc);
      open[7 + 2 * i] = 1e3 * (r[2] - zc);
    }
    return true;
  }

  template <typename T, typename V>
  static void rotated(const T* rotation, const V& point, T* turned) {
    for (int k = 0; k < 3; ++k) {
      turned[k] = rotation[k] * point[0] + rotation[3 + k] * point[1] + rotation[6 + k] * point[2];
    }
  }
};

// One cable with given end and tension; unknowns: angle and length.
struct Held {
  enum { NUM_RESIDUALS = 2, NUM_PARAMETERS = 2 };
  const Robot& robot;
  double tension, h, z;

  template <typename T>
  bool operator()(const T* x, T* open) const {
    using std::cos, std::sin;
    const T fx = tension * cos(x[0]), fz = tension * sin(x[0]);
    T xc, zc;
    catenary(fx, fz, x[1], robot.w, robot.ea, xc, zc);
    open[0] = 1e3 * (h - xc);
    open[1] = 1e3 * (z - zc);
    return true;
  }
};

bool tiny = false;

// Brings all equations to zero; column i of `x` holds the unknowns of equations i.
template <typename Equations, int Count>
void solve(const std::vector<Equations>& equations,
           Eigen::Matrix<double, Equations::NUM_PARAMETERS, Count>& x) {
  constexpr int n = Equations::NUM_PARAMETERS;
  if (tiny) {
    using Function = ceres::TinySolverAutoDiffFunction<Equations, n, n>;
    ceres::TinySolver<Function, Eigen::PartialPivLU<Eigen::Matrix<double, n, n>>> solver;
    solver.options.initial_trust_region_radius = 1e16;
    solver.options.parameter_tolerance = 0;
    solver.options.gradient_tolerance = 0;
    solver.options.function_tolerance = 0;
    solver.options.cost_threshold = 1e-18;  // residual of 1.4e-9 mm or N
    for (int i = 0; i < Count; ++i) {
      Vector<n> column = x.col(i);
      solver.Solve(Function(equations[i]), &column);
      if (!(solver.summary.final_cost < 1e-16)) throw std::runtime_error("TinySolver has not converged");
      x.col(i) = column;
    }
    return;
  }
  ceres::Problem problem;
  for (int i = 0; i < Count; ++i) {
    auto* function = new ceres::AutoDiffCostFunction<Equations, n, n>(new Equations(equations[i]));
    problem.AddResidualBlock(function, nullptr, x.col(i).data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  options.initial_trust_region_radius = 1e16;
  options.max_trust_region_radius = 1e32;
  options.parameter_tolerance = options.function_tolerance = 0;
  options.gradient_tolerance = 1e-6;  // lengths [m] against residuals [mm]: 1e-9 mm
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!(summary.final_cost < 1e-16)) throw std::runtime_error(summary.BriefReport());
}

Vector<22> direct(const Robot& robot, const Vector8& lengths, double payload, Vector<22> x) {
  solve<Direct, 1>({{robot, lengths, robot.mass + payload}}, x);
  return x;
}

// Displacement dp under the payload.
Vector<3> observation(const Robot& robot, const Vector<3>& position, double payload) {
  const Eigen::Matrix<double, 3, 8> r = (robot.a - robot.b).colwise() + position;
  const Vector8 h = r.topRows<2>().colwise().norm(), z = r.row(2);
  Eigen::Matrix<double, 2, 8> held;  // angle, length
  for (int i = 0; i < 8; ++i) held.col(i) << std::atan2(z[i], h[i]), r.col(i).norm();
  const auto hold = [&](const Vector8& tensions) {
    std::vector<Held> cables;
    for (int i = 0; i < 8; ++i) cables.push_back({robot, tensions[i], h[i], z[i]});
    solve<Held, 8>(cables, held);
  };
  // Inverse model: least-norm tensions at the position with R = 1.
  const double mg = -robot.mass * robot.g;
  Vector<6> wrench;
  wrench << 0, 0, mg, robot.center[1] * mg, -robot.center[0] * mg, 0;
  Vector8 tensions;
  for (double moved = 1; moved >= 1e-12;) {
    Eigen::Matrix<double, 6, 8> matrix;
    for (int i = 0; i < 8; ++i) {
      const double c = std::cos(held(0, i)), s = std::sin(held(0, i));
      const Eigen::Vector3d pull(-c * r(0, i) / h[i], -c * r(1, i) / h[i], -s), arm = robot.a.col(i);
      matrix.col(i) << pull, arm.cross(pull);
    }
    tensions = -matrix.transpose() * (matrix * matrix.transpose()).ldlt().solve(wrench);
    const Vector8 before = held.row(0);
    hold(tensions);
    moved = (held.row(0).transpose() - before).cwiseAbs().maxCoeff();
  }
  tensions += robot.dt;
  hold(tensions);
  Vector<22> start = Vector<22>::Zero();
  start.head<3>() = position;
  for (int i = 0; i < 8; ++i) {
    const double angle = held(0, i);
    start.segment<2>(6 + 2 * i) << tensions[i] * std::cos(angle), tensions[i] * std::sin(angle);
  }
  const Vector8 lengths = held.row(1);
  const Vector<22> unloaded = direct(robot, lengths, 0, start);
  return direct(robot, lengths, payload, unloaded).head<3>() - unloaded.head<3>();
}

double cpu_time_us() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * now.tv_sec + 1e-3 * now.tv_nsec;
}

// Result, and CPU times [us]; the first call is not timed.
template <typename Run>
auto timed(Run run, int repeats, std::vector<double>& times) {
  const auto result = run();
  for (int i = 0; i < repeats; ++i) {
    const double begin = cpu_time_us();
    run();
    times.push_back(cpu_time_us() - begin);
  }
  return result;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Eigen::VectorXd vector(const json& list) {
  const auto values = list.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
}

int main(int count, char** arguments) try {
  if (count < 2) throw std::invalid_argument("usage: ceres PROBLEM.json [tiny]");
  tiny = count > 2 && std::string(arguments[2]) == "tiny";
  const json problem = json::parse(std::ifstream(arguments[1]));
  const double gravity = problem["gravity"], section = problem["section"], payload = problem["payload"];
  const Eigen::VectorXd nominal = vector(problem["parameters"]);
  const Vector<3> position = vector(problem["position"]);
  const Vector8 lengths = vector(problem["lengths"]);
  const int repeats = 100 * problem["repeats"].get<int>();
  Vector<22> start = Vector<22>::Zero();
  start.head<3>() = position;
  for (int i = 0; i < 8; ++i) start.segment<2>(6 + 2 * i) = vector(problem["forces"][i]);

  const Robot robot(gravity, section, nominal);
  std::vector<double> direct_times, times;
  const Vector<22> loaded =
      timed([&] { return direct(robot, lengths, payload, start); }, repeats, direct_times);
  json displacements;
  for (const json& row : problem["deviations"]) {
    const Eigen::VectorXd deviation = vector(row);
    const auto observe = [&] {
      return observation(Robot(gravity, section, nominal + deviation), position, payload);
    };
    const Vector<3> dp = timed(observe, repeats, times);
    displacements.push_back({dp[0], dp[1], dp[2]});
  }
  std::cout << json{{"version", CERES_VERSION_STRING},
                    {"solver", tiny ? "TinySolver, LU, autodiff" : "ceres::Solve, dense Cholesky, autodiff"},
                    {"direct_us", median(direct_times)},
                    {"direct_position", {loaded[0], loaded[1], loaded[2]}},
                    {"observation_us", median(times)},
                    {"displacements", displacements}};
  return 0;
} catch (const std::exception& error) {
  std::cerr << "error: " << error.what() << "\n";
  return 1;
}
