// Prints the bits of what the ROS node computes, without ROS: ros_logic ROBOT.json X Y Z STEPS
#include <cdpr_ros/logic.hpp>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

static void print(const char * name, const double * values, std::size_t count)
{
  std::printf("%s", name);
  for (std::size_t i = 0; i < count; i++) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &values[i], sizeof bits);
    std::printf(" %016" PRIx64, bits);
  }
  std::printf("\n");
}

static void need(bool good, const cdpr_ros::Robot & robot)
{
  if (!good) {
    std::fprintf(stderr, "%s\n", robot.message().c_str());
    std::exit(1);
  }
}

// What a call that has to fail says.
static void refused(bool good, const cdpr_ros::Robot & robot)
{
  std::printf("%d %s\n", good, robot.message().c_str());
}

int main(int count, char ** arguments)
{
  if (count != 6) {
    return 2;
  }
  cdpr_ros::Point at{};
  for (std::size_t i = 0; i < 3; i++) {
    at[i] = std::strtod(arguments[2 + i], nullptr);
  }
  const CdprPose start = cdpr_ros::pose_of(at, {1.0, 0.0, 0.0, 0.0});
  const CdprLoad none{}, load = {2.0, {1.0, -2.0, 3.0}, {0.25, 0.5, -0.25}};
  cdpr_ros::Robot robot;
  need(robot.open(arguments[1]), robot);
  cdpr_ros::SetPoint wanted;
  need(robot.set_point(start, none, wanted), robot);
  print("lengths", wanted.lengths.data(), wanted.lengths.size());
  print("tensions", wanted.tensions.data(), wanted.tensions.size());

  // A message in another order than the cables.
  std::vector<std::string> joints, reversed;
  for (std::size_t i = 0; i < robot.cables(); i++) {
    joints.push_back("cable_" + std::to_string(i + 1));
    reversed.insert(reversed.begin(), joints.back());
  }
  std::vector<double> lengths = wanted.lengths, backwards(lengths.rbegin(), lengths.rend());
  need(robot.ordered(reversed, backwards, joints, lengths) && lengths == wanted.lengths, robot);

  cdpr_ros::Estimate found{};
  for (long k = 0; k <= std::strtol(arguments[5], nullptr, 10); k++) {
    need(robot.estimate(lengths, load, start, found), robot);
    print("position", found.pose.position, 3);
    print("quaternion", found.pose.quaternion, 4);
    print("tensions", found.tensions.data(), found.tensions.size());
    std::printf("restarted %d, residual below 1e-6: %d\n", found.restarted, found.report.force < 1e-6);
    lengths[0] -= 1e-5;
  }
  std::vector<cdpr_ros::Point> lines;
  need(robot.lines(4, lines), robot);
  for (const cdpr_ros::Point & end : lines) {
    std::printf("line %.9f %.9f %.9f\n", end[0], end[1], end[2]);
  }

  // What is refused, and that the node goes on after it.
  backwards.pop_back();
  refused(robot.ordered(reversed, backwards, joints, lengths), robot);
  refused(robot.ordered({}, backwards, joints, lengths), robot);
  lengths = wanted.lengths;
  lengths[0] = NAN;
  refused(robot.estimate(lengths, load, start, found), robot);
  need(robot.estimate(wanted.lengths, load, start, found), robot);
  refused(robot.open("nothing.json"), robot);
  refused(robot.open("no robot"), robot);
  return 0;
}
