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
// Inverse model: the stationary point of sum t_i^2 / 2 + l . (balance) at R = 1, as 3m + 6 equations. Unknowns
// are the tension, angle s and length of every cable and the multipliers l; equations (2a), (2b) with
// fx = t cos s, fz = t sin s, (3), and t_i + l . dw_i/dt_i = 0, where the angle follows the tension by (2).
// Ceres has no constraints beside bounds: where a tension of this point is beyond its limit there is no answer.
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
template <int M>
using Points = Eigen::Matrix<double, 3, M>;

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

// Robot with the parameter vector: mass, density, modulus, a (3m), b (3m), centre of mass, dt (m).
template <int M>
struct Robot {
  double g, mass, w, ea;
  Points<M> a, b;
  Vector<3> center;
  Vector<M> dt;

  Robot(double gravity, double section, const Eigen::VectorXd& parameters)
      : g(gravity), mass(parameters[0]), w(parameters[1] * g), ea(parameters[2] * section) {
    a = Eigen::Map<const Points<M>>(&parameters[3]);
    b = Eigen::Map<const Points<M>>(&parameters[3 + 3 * M]);
    center = parameters.segment<3>(3 + 6 * M);
    dt = parameters.segment<M>(6 + 6 * M);
  }
};

// The 6 + 2m equations.
template <int M>
struct Direct {
  enum { NUM_RESIDUALS = 6 + 2 * M, NUM_PARAMETERS = 6 + 2 * M };
  const Robot<M>& robot;
  const Vector<M>& lengths;
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
    for (int i = 0; i < M; ++i) {
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
  double w, ea, tension, h, z;

  template <typename T>
  bool operator()(const T* x, T* open) const {
    using std::cos, std::sin;
    const T fx = tension * cos(x[0]), fz = tension * sin(x[0]);
    T xc, zc;
    catenary(fx, fz, x[1], w, ea, xc, zc);
    open[0] = 1e3 * (h - xc);
    open[1] = 1e3 * (z - zc);
    return true;
  }
};

// Stationarity; tensions and multipliers in units of the weight, x = (t, s, L) of every cable, l.
template <int M>
struct LeastNorm {
  enum { NUM_RESIDUALS = 3 * M + 6, NUM_PARAMETERS = 3 * M + 6 };
  const Robot<M>& robot;
  const Points<M>& r;

  template <typename T>
  bool operator()(const T* x, T* open) const {
    using std::cos, std::sin, std::sqrt;
    const double mg = robot.mass * robot.g;
    const T* multipliers = x + 3 * M;
    T* balance = open + 3 * M;
    const double weight[6] = {0, 0, -1, -robot.center[1], robot.center[0], 0};
    for (int k = 0; k < 6; ++k) balance[k] = T(-mg * weight[k]);
    for (int i = 0; i < M; ++i) {
      const double h = r.col(i).template head<2>().norm();
      const T t = mg * x[3 * i], c = cos(x[3 * i + 1]), s = sin(x[3 * i + 1]), fx = t * c, fz = t * s;
      const T &length = x[3 * i + 2], v0 = fz - robot.w * length;
      const T upper = t, lower = sqrt(fx * fx + v0 * v0);
      T xc, zc;
      catenary(fx, fz, length, robot.w, robot.ea, xc, zc);
      open[3 * i] = 1e3 * (h - xc);
      open[3 * i + 1] = 1e3 * (r(2, i) - zc);
      // Derivatives of the end by fx, fz and L, then that of the angle by the tension, with both ends held.
      const T x_fx = xc / fx + (v0 / lower - fz / upper) / robot.w, x_fz = (fx / upper - fx / lower) / robot.w;
      const T z_fz = length / robot.ea + (fz / upper - v0 / lower) / robot.w;
      const T x_l = fx / robot.ea + fx / lower, z_l = v0 / robot.ea + v0 / lower;
      const T x_t = x_fx * c + x_fz * s, z_t = x_fz * c + z_fz * s;
      const T x_s = t * (x_fz * c - x_fx * s), z_s = t * (z_fz * c - x_fz * s);
      const T slope = -(x_t * z_l - z_t * x_l) / (x_s * z_l - z_s * x_l);
      const T f_h = c - t * s * slope, f_z = s + t * c * slope;  // dF/dt
      const double e[2] = {r(0, i) / h, r(1, i) / h};
      const T f[3] = {fx * e[0], fx * e[1], fz}, df[3] = {f_h * e[0], f_h * e[1], f_z};
      T arm[3] = {T(robot.a(0, i)), T(robot.a(1, i)), T(robot.a(2, i))}, moment[3], dm[3];
      ceres::CrossProduct(arm, f, moment);
      ceres::CrossProduct(arm, df, dm);
      T gradient = mg * x[3 * i];
      for (int k = 0; k < 3; ++k) {
        balance[k] += f[k];
        balance[3 + k] += moment[k];
        gradient += multipliers[k] * df[k] + multipliers[3 + k] * dm[k];
      }
      open[3 * i + 2] = gradient;
    }
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

template <int M>
Vector<6 + 2 * M> direct(const Robot<M>& robot, const Vector<M>& lengths, double payload, Vector<6 + 2 * M> x) {
  solve<Direct<M>, 1>({{robot, lengths, robot.mass + payload}}, x);
  return x;
}

// Tension, angle and length of every cable in a column, at a position with R = 1.
template <int M>
Points<M> inverse(const Robot<M>& robot, const Vector<3>& position) {
  const Points<M> r = (robot.a - robot.b).colwise() + position;
  const double mg = robot.mass * robot.g;
  Eigen::Matrix<double, 6, M> wrenches;  // of straight cables
  for (int i = 0; i < M; ++i) {
    const Eigen::Vector3d pull = r.col(i).normalized(), arm = robot.a.col(i);
    wrenches.col(i) << pull, arm.cross(pull);
  }
  Vector<6> weight;
  weight << 0, 0, -mg, -robot.center[1] * mg, robot.center[0] * mg, 0;
  const Vector<6> multipliers = -(wrenches * wrenches.transpose()).ldlt().solve(weight);
  const Vector<M> tensions = -wrenches.transpose() * multipliers;
  Vector<3 * M + 6> x;
  for (int i = 0; i < M; ++i) {
    x.template segment<3>(3 * i) << tensions[i] / mg,
        std::atan2(r(2, i), r.col(i).template head<2>().norm()), r.col(i).norm();
  }
  x.template tail<6>() = multipliers;
  solve<LeastNorm<M>, 1>({{robot, r}}, x);
  Points<M> held = Eigen::Map<const Points<M>>(x.data());
  held.row(0) *= mg;
  return held;
}

// Displacement dp under the payload.
template <int M>
Vector<3> observation(const Robot<M>& robot, const Vector<3>& position, double payload) {
  const Points<M> r = (robot.a - robot.b).colwise() + position;
  const Points<M> wanted = inverse(robot, position);
  const Vector<M> tensions = wanted.row(0).transpose() + robot.dt;
  Eigen::Matrix<double, 2, M> held = wanted.template bottomRows<2>();  // angle, length
  std::vector<Held> cables;
  for (int i = 0; i < M; ++i) {
    cables.push_back({robot.w, robot.ea, tensions[i], r.col(i).template head<2>().norm(), r(2, i)});
  }
  solve<Held, M>(cables, held);
  Vector<6 + 2 * M> start = Vector<6 + 2 * M>::Zero();
  start.template head<3>() = position;
  for (int i = 0; i < M; ++i) {
    const double angle = held(0, i);
    start.template segment<2>(6 + 2 * i) << tensions[i] * std::cos(angle), tensions[i] * std::sin(angle);
  }
  const Vector<M> lengths = held.row(1);
  const Vector<6 + 2 * M> unloaded = direct<M>(robot, lengths, 0, start);
  return direct<M>(robot, lengths, payload, unloaded).template head<3>() - unloaded.template head<3>();
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

// Answers and times of a case of m cables; null where limits are active.
template <int M>
json answer(const json& problem, int repeats) {
  const double gravity = problem["gravity"], section = problem["section"], payload = problem["payload"];
  const Eigen::VectorXd nominal = vector(problem["parameters"]);
  const Vector<3> position = vector(problem["position"]);
  const Vector<M> lengths = vector(problem["lengths"]);
  const Vector<M> least = vector(problem["least"]), greatest = vector(problem["greatest"]);
  Vector<6 + 2 * M> start = Vector<6 + 2 * M>::Zero();
  start.template head<3>() = position;
  for (int i = 0; i < M; ++i) start.template segment<2>(6 + 2 * i) = vector(problem["forces"][i]);

  const Robot<M> robot(gravity, section, nominal);
  std::vector<double> direct_times, inverse_times, times;
  const auto loaded =
      timed([&] { return direct<M>(robot, lengths, payload, start); }, repeats, direct_times);
  json found = {{"direct_us", median(direct_times)},
                {"direct_position", {loaded[0], loaded[1], loaded[2]}},
                {"inverse_us", nullptr},
                {"tensions", nullptr},
                {"observation_us", nullptr},
                {"displacements", nullptr}};
  const auto limits_are_active = [&] {
    for (const json& count : problem["at_limits"]) {
      if (count.get<int>() > 0) return true;
    }
    return false;
  };
  if (limits_are_active()) return found;
  const Points<M> held = timed([&] { return inverse<M>(robot, position); }, repeats, inverse_times);
  const Vector<M> tensions = held.row(0);
  if (!((tensions - least).minCoeff() >= 0 && (greatest - tensions).minCoeff() >= 0)) {
    throw std::runtime_error("a tension is beyond its limits");
  }
  json displacements;
  for (const json& row : problem["deviations"]) {
    const Eigen::VectorXd deviation = vector(row);
    const auto observe = [&] {
      return observation<M>(Robot<M>(gravity, section, nominal + deviation), position, payload);
    };
    const Vector<3> dp = timed(observe, repeats, times);
    displacements.push_back({dp[0], dp[1], dp[2]});
  }
  found["inverse_us"] = median(inverse_times);
  found["tensions"] = std::vector<double>(tensions.data(), tensions.data() + M);
  found["observation_us"] = median(times);
  found["displacements"] = displacements;
  return found;
}

int main(int count, char** arguments) try {
  if (count < 2) throw std::invalid_argument("usage: ceres PROBLEM.json [tiny]");
  tiny = count > 2 && std::string(arguments[2]) == "tiny";
  const json problem = json::parse(std::ifstream(arguments[1]));
  const int repeats = 100 * problem["repeats"].get<int>();
  json answers;
  for (const json& item : problem["cases"]) {
    switch (item["lengths"].size()) {  // sizes are fixed when compiled
      case 6: answers.push_back(answer<6>(item, repeats)); break;
      case 8: answers.push_back(answer<8>(item, repeats)); break;
      default: throw std::invalid_argument("expected 6 or 8 cables");
    }
  }
  std::cout << json{{"version", CERES_VERSION_STRING},
                    {"solver", tiny ? "TinySolver, LU, autodiff" : "ceres::Solve, Cholesky, autodiff"},
                    {"cases", answers}};
  return 0;
} catch (const std::exception& error) {
  std::cerr << "error: " << error.what() << "\n";
  return 1;
}
