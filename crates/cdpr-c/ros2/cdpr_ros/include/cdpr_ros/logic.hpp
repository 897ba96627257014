// What the node computes, without ROS: poses from lengths, lengths from poses, lines of the cables.
//
// A function that can fail returns false, and `message()` says why.
#ifndef CDPR_ROS_LOGIC_HPP
#define CDPR_ROS_LOGIC_HPP

#include <algorithm>
#include <array>
#include <cdpr.h>
#include <cstddef>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace cdpr_ros
{

using Point = std::array<double, 3>;

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

// A robot with what follows its platform and what plans its lengths.
class Robot
{
public:
  // A robot of the library by its name, or of a file whose name ends with .json.
  bool open(const std::string & name)
  {
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

  // No tension of a set-point changes by more than this from one pose to the next [N].
  bool limit_change(double change) { return good(cdpr_path_limit_change(path_.get(), change)); }

  // The lengths that hold the next pose of a path under a load.
  bool set_point(const CdprPose & pose, const CdprLoad & load, SetPoint & found)
  {
    found.lengths.resize(cables());
    found.tensions.resize(cables());
    const CdprCables cables = {found.lengths.size(), found.lengths.data(), found.tensions.data()};
    return good(cdpr_path_next(path_.get(), &pose, &load, nullptr, &cables, &found.report));
  }

  // The cables as they hang after the last estimate: both ends of each of `pieces` lines a cable.
  bool lines(std::size_t pieces, std::vector<Point> & ends)
  {
    std::vector<double> values(3 * (pieces + 1));
    ends.clear();
    for (std::size_t i = 0; i < cables(); i++) {
      if (!good(cdpr_tracker_shape(tracker_.get(), i, values.data(), pieces + 1))) {
        return false;
      }
      for (std::size_t k = 0; k < pieces; k++) {
        for (const std::size_t end : {k, k + 1}) {
          ends.push_back({values[3 * end], values[3 * end + 1], values[3 * end + 2]});
        }
      }
    }
    return true;
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

  std::unique_ptr<CdprRobot, Free> robot_;
  std::unique_ptr<CdprTracker, Free> tracker_;
  std::unique_ptr<CdprPath, Free> path_;
  std::string message_;
};

}  // namespace cdpr_ros

#endif  // CDPR_ROS_LOGIC_HPP
