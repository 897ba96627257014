// What the node computes, without ROS: poses from lengths, lengths from poses, lines of the cables.
//
// A function that can fail returns false, and `message()` says why.
#ifndef CDPR_ROS_LOGIC_HPP
#define CDPR_ROS_LOGIC_HPP

#include <algorithm>
#include <array>
#include <cdpr.h>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace cdpr_ros
{

using Point = std::array<double, 3>;

// Point of a cable at the base, and on the platform in its frame [m].
struct CablePoints
{
  Point exit;
  Point anchor;
};

// Where the platform is: its pose, tensions at the platform [N], and residuals.
struct Estimate
{
  CdprPose pose;
  std::vector<double> tensions;
  CdprReport report;
  // Whether the tracker began again: at the first lengths, and where a step did not converge.
  bool restarted;
};

// Lengths [m] that hold a pose, and their tensions at the platform [N].
struct SetPoint
{
  std::vector<double> lengths;
  std::vector<double> tensions;
  CdprReport report;
};

inline CdprPose pose_of(const Point & position, const std::array<double, 4> & wxyz)
{
  return {{position[0], position[1], position[2]}, {wxyz[0], wxyz[1], wxyz[2], wxyz[3]}};
}

// A point of the platform in the base frame: p + R a.
inline Point placed(const CdprPose & pose, const Point & a)
{
  const double * q = pose.quaternion;
  const Point u = {q[1], q[2], q[3]};
  // R a = a + 2 u x (u x a + w a)
  const auto cross = [](const Point & x, const Point & y) -> Point {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  };
  Point inner = cross(u, a);
  for (std::size_t i = 0; i < 3; i++) {
    inner[i] += q[0] * a[i];
  }
  Point point = cross(u, inner);
  for (std::size_t i = 0; i < 3; i++) {
    point[i] = pose.position[i] + a[i] + 2.0 * point[i];
  }
  return point;
}

// The values of all fields `"key": [x, y, z]` of a robot file, in their order.
inline std::vector<Point> points_of(const std::string & text, const std::string & key)
{
  std::vector<Point> points;
  const std::string quoted = "\"" + key + "\"";
  const char * const blank = " \t\r\n";
  for (std::size_t at = text.find(quoted); at != std::string::npos; at = text.find(quoted, at)) {
    at = text.find_first_not_of(blank, at + quoted.size());
    if (at == std::string::npos || text[at] != ':') {
      continue;
    }
    at = text.find_first_not_of(blank, at + 1);
    if (at == std::string::npos || text[at] != '[') {
      continue;
    }
    Point point{};
    const char * next = text.c_str() + at;
    bool complete = true;
    for (double & value : point) {
      char * end = nullptr;
      value = std::strtod(next + 1, &end);
      complete = complete && end != next + 1;
      next = end + std::strspn(end, blank);
      complete = complete && (*next == ',' || *next == ']');
    }
    if (complete && *next == ']') {
      points.push_back(point);
    }
  }
  return points;
}

// A robot with what follows its platform and what plans its lengths.
class Robot
{
public:
  // A robot of the library by its name, or of a file whose name ends with .json.
  bool open(const std::string & name)
  {
    cables_.clear();
    CdprRobot * robot = nullptr;
    CdprPath * path = nullptr;
    CdprStatus status = CDPR_STATUS_OK;
    const bool is_file = name.size() > 5 && name.compare(name.size() - 5, 5, ".json") == 0;
    if (is_file) {
      std::ifstream file(name);
      std::stringstream text;
      text << file.rdbuf();
      if (!file) {
        return failed("the file " + name + " cannot be read");
      }
      const std::string json = text.str();
      status = cdpr_robot_from_json(json.data(), json.size(), &robot);
      read_points(json, cdpr_robot_cables(robot));
    } else {
      status = cdpr_robot_named(name.c_str(), &robot);
    }
    robot_.reset(robot);
    tracker_.reset();
    if (!good(status) || !good(cdpr_path_new(robot, &path))) {
      return false;
    }
    path_.reset(path);
    return true;
  }

  std::size_t cables() const { return cdpr_robot_cables(robot_.get()); }

  const std::string & message() const { return message_; }

  // Exit and anchor points; none for a robot of the library, whose file is not at hand.
  const std::vector<CablePoints> & cable_points() const { return cables_; }

  // The values of a message in the order of the cables, which they have already where `names` is empty.
  bool ordered(
    const std::vector<std::string> & names, const std::vector<double> & values,
    const std::vector<std::string> & joints, std::vector<double> & lengths)
  {
    if (names.empty()) {
      lengths = values;
      return lengths.size() == cables() || failed("expected a length for each of the cables");
    }
    lengths.clear();
    for (const std::string & joint : joints) {
      const auto at = std::find(names.begin(), names.end(), joint);
      const auto index = static_cast<std::size_t>(at - names.begin());
      if (at == names.end() || index >= values.size()) {
        return failed("the message has no position of the joint " + joint);
      }
      lengths.push_back(values[index]);
    }
    return true;
  }

  // Where the platform is for lengths [m] and a load. The first call searches from `start`, later ones follow
  // the platform; where a step does not converge, the search begins again at the last pose.
  bool estimate(
    const std::vector<double> & lengths, const CdprLoad & load, const CdprPose & start, Estimate & found)
  {
    const std::size_t n = cables();
    found.tensions.resize(n);
    found.restarted = false;
    CdprStatus status = CDPR_STATUS_NOT_CONVERGED;
    CdprPose from = start;
    if (tracker_) {
      status = cdpr_tracker_step(tracker_.get(), lengths.data(), lengths.size(), &load, &found.report);
      cdpr_tracker_state(tracker_.get(), &from, nullptr, 0);
    }
    if (status == CDPR_STATUS_NOT_CONVERGED) {
      CdprTracker * tracker = nullptr;
      status = cdpr_tracker_new(robot_.get(), lengths.data(), lengths.size(), &load, &from, &tracker);
      if (!good(status)) {
        return false;
      }
      tracker_.reset(tracker);
      found.restarted = true;
      // A step to where it is has the residuals.
      status = cdpr_tracker_step(tracker, lengths.data(), lengths.size(), &load, &found.report);
    }
    return good(status) && good(cdpr_tracker_state(tracker_.get(), &found.pose, found.tensions.data(), n));
  }

  // The lengths that hold the next pose of a path under a load.
  bool set_point(const CdprPose & pose, const CdprLoad & load, SetPoint & found)
  {
    found.lengths.resize(cables());
    found.tensions.resize(cables());
    const CdprCables cables = {found.lengths.size(), found.lengths.data(), found.tensions.data()};
    return good(cdpr_path_next(path_.get(), &pose, &load, &cables, &found.report));
  }

  // Both ends of each cable at a pose, one pair after the other, for a list of lines.
  std::vector<Point> lines(const CdprPose & pose) const
  {
    std::vector<Point> ends;
    for (const CablePoints & cable : cables_) {
      ends.push_back(cable.exit);
      ends.push_back(placed(pose, cable.anchor));
    }
    return ends;
  }

private:
  struct Free
  {
    void operator()(CdprRobot * robot) const { cdpr_robot_free(robot); }
    void operator()(CdprTracker * tracker) const { cdpr_tracker_free(tracker); }
    void operator()(CdprPath * path) const { cdpr_path_free(path); }
  };

  bool failed(std::string why)
  {
    message_ = std::move(why);
    return false;
  }

  bool good(CdprStatus status) { return status == CDPR_STATUS_OK || failed(cdpr_message()); }

  // The points of the cables, none where the file does not give both of each as three numbers.
  void read_points(const std::string & json, std::size_t cables)
  {
    const std::vector<Point> exits = points_of(json, "exit_point"), anchors = points_of(json, "anchor_point");
    if (exits.size() == cables && anchors.size() == cables) {
      for (std::size_t i = 0; i < cables; i++) {
        cables_.push_back({exits[i], anchors[i]});
      }
    }
  }

  std::unique_ptr<CdprRobot, Free> robot_;
  std::unique_ptr<CdprTracker, Free> tracker_;
  std::unique_ptr<CdprPath, Free> path_;
  std::vector<CablePoints> cables_;
  std::string message_;
};

}  // namespace cdpr_ros

#endif  // CDPR_ROS_LOGIC_HPP
