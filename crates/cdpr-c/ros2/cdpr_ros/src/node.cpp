// The node `cdpr`: lengths -> pose, tensions, TF and lines of the cables; pose -> lengths and tensions.

#include <chrono>
#include <functional>
#include <geometry_msgs/msg/pose_stamped.hpp>
#include <geometry_msgs/msg/transform_stamped.hpp>
#include <geometry_msgs/msg/wrench_stamped.hpp>
#include <limits>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <stdexcept>
#include <string>
#include <tf2_ros/transform_broadcaster.h>
#include <vector>
#include <visualization_msgs/msg/marker.hpp>

#include "cdpr_ros/logic.hpp"

using geometry_msgs::msg::PoseStamped;
using geometry_msgs::msg::WrenchStamped;
using sensor_msgs::msg::JointState;
using visualization_msgs::msg::Marker;

class CdprNode : public rclcpp::Node
{
public:
  CdprNode() : Node("cdpr"), transforms_(*this)
  {
    const auto name = declare_parameter<std::string>("robot", "caroca");
    if (!robot_.open(name)) {
      throw std::runtime_error("robot: " + robot_.message());
    }
    std::vector<std::string> joints;
    for (std::size_t i = 1; i <= robot_.cables(); i++) {
      joints.push_back("cable_" + std::to_string(i));
    }
    joints_ = declare_parameter<std::vector<std::string>>("joints", joints);
    base_ = declare_parameter<std::string>("base_frame", "base");
    platform_ = declare_parameter<std::string>("platform_frame", "platform");
    load_.payload = declare_parameter<double>("payload", 0.0);
    const auto start = declare_parameter<std::vector<double>>("start", {0.0, 0.0, 1.0});
    if (joints_.size() != robot_.cables() || start.size() != 3) {
      throw std::runtime_error("expected a joint for each cable, and three coordinates of `start`");
    }
    start_ = cdpr_ros::pose_of({start[0], start[1], start[2]}, {1.0, 0.0, 0.0, 0.0});
    const auto change = declare_parameter<double>("tension_change", std::numeric_limits<double>::infinity());
    if (!robot_.limit_change(change)) {
      throw std::runtime_error("tension_change: " + robot_.message());
    }
    pose_ = create_publisher<PoseStamped>("pose", 10);
    tensions_ = create_publisher<JointState>("tensions", 10);
    set_points_ = create_publisher<JointState>("set_points", 10);
    cables_ = create_publisher<Marker>("cables", 10);
    using std::placeholders::_1;
    lengths_ = create_subscription<JointState>("lengths", 10, std::bind(&CdprNode::on_lengths, this, _1));
    wanted_ = create_subscription<PoseStamped>("wanted_pose", 10, std::bind(&CdprNode::on_pose, this, _1));
    wrench_ = create_subscription<WrenchStamped>("load", 10, std::bind(&CdprNode::on_load, this, _1));
  }

private:
  // Force and moment about the reference point, in the base frame.
  void on_load(const WrenchStamped & message)
  {
    const auto & force = message.wrench.force;
    const auto & torque = message.wrench.torque;
    load_ = {load_.payload, {force.x, force.y, force.z}, {torque.x, torque.y, torque.z}};
  }

  void on_lengths(const JointState & message)
  {
    if (
      !robot_.ordered(message.name, message.position, joints_, ordered_) ||
      !robot_.estimate(ordered_, load_, start_, estimate_)) {
      RCLCPP_WARN_THROTTLE(get_logger(), *get_clock(), 1000, "lengths: %s", robot_.message().c_str());
      return;
    }
    if (estimate_.restarted) {
      RCLCPP_INFO(get_logger(), "the search for the pose began again");
    }
    auto header = message.header;
    header.frame_id = base_;
    PoseStamped pose;
    pose.header = header;
    const CdprPose & found = estimate_.pose;
    pose.pose.position.x = found.position[0];
    pose.pose.position.y = found.position[1];
    pose.pose.position.z = found.position[2];
    pose.pose.orientation.w = found.quaternion[0];
    pose.pose.orientation.x = found.quaternion[1];
    pose.pose.orientation.y = found.quaternion[2];
    pose.pose.orientation.z = found.quaternion[3];
    pose_->publish(pose);
    publish_transform(pose);
    JointState tensions;
    tensions.header = header;
    tensions.name = joints_;
    tensions.position = ordered_;
    tensions.effort = estimate_.tensions;
    tensions_->publish(tensions);
    publish_cables(pose);
  }

  void publish_transform(const PoseStamped & pose)
  {
    geometry_msgs::msg::TransformStamped transform;
    transform.header = pose.header;
    transform.child_frame_id = platform_;
    transform.transform.translation.x = pose.pose.position.x;
    transform.transform.translation.y = pose.pose.position.y;
    transform.transform.translation.z = pose.pose.position.z;
    transform.transform.rotation = pose.pose.orientation;
    transforms_.sendTransform(transform);
  }

  // Each cable as it hangs, in 20 straight pieces.
  void publish_cables(const PoseStamped & pose)
  {
    Marker marker;
    marker.header = pose.header;
    marker.ns = "cables";
    marker.type = Marker::LINE_LIST;
    marker.action = Marker::ADD;
    marker.pose.orientation.w = 1.0;
    marker.scale.x = 0.01;
    marker.color.r = 0.1F;
    marker.color.g = 0.4F;
    marker.color.b = 0.7F;
    marker.color.a = 1.0F;
    if (!robot_.lines(20, lines_)) {
      RCLCPP_WARN_THROTTLE(get_logger(), *get_clock(), 1000, "cables: %s", robot_.message().c_str());
      return;
    }
    for (const cdpr_ros::Point & end : lines_) {
      geometry_msgs::msg::Point point;
      point.x = end[0];
      point.y = end[1];
      point.z = end[2];
      marker.points.push_back(point);
    }
    cables_->publish(marker);
  }

  void on_pose(const PoseStamped & message)
  {
    const auto & position = message.pose.position;
    const auto & turned = message.pose.orientation;
    const CdprPose pose =
      cdpr_ros::pose_of({position.x, position.y, position.z}, {turned.w, turned.x, turned.y, turned.z});
    if (!robot_.set_point(pose, load_, set_point_)) {
      RCLCPP_WARN_THROTTLE(get_logger(), *get_clock(), 1000, "wanted_pose: %s", robot_.message().c_str());
      return;
    }
    if (set_point_.report.jump != 0) {
      RCLCPP_WARN(get_logger(), "wanted_pose: the tensions have left their branch, and the lengths may jump");
    }
    JointState lengths;
    lengths.header = message.header;
    lengths.name = joints_;
    lengths.position = set_point_.lengths;
    lengths.effort = set_point_.tensions;
    set_points_->publish(lengths);
  }

  cdpr_ros::Robot robot_;
  std::vector<std::string> joints_;
  std::string base_, platform_;
  CdprPose start_{};
  CdprLoad load_{};
  std::vector<double> ordered_;
  std::vector<cdpr_ros::Point> lines_;
  cdpr_ros::Estimate estimate_{};
  cdpr_ros::SetPoint set_point_{};
  tf2_ros::TransformBroadcaster transforms_;
  rclcpp::Publisher<PoseStamped>::SharedPtr pose_;
  rclcpp::Publisher<JointState>::SharedPtr tensions_, set_points_;
  rclcpp::Publisher<Marker>::SharedPtr cables_;
  rclcpp::Subscription<JointState>::SharedPtr lengths_;
  rclcpp::Subscription<PoseStamped>::SharedPtr wanted_;
  rclcpp::Subscription<WrenchStamped>::SharedPtr wrench_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  int code = 0;
  try {
    rclcpp::spin(std::make_shared<CdprNode>());
  } catch (const std::exception & error) {
    RCLCPP_FATAL(rclcpp::get_logger("cdpr"), "%s", error.what());
    code = 1;
  }
  rclcpp::shutdown();
  return code;
}
