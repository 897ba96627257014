"""Starts the node `cdpr`: ros2 launch cdpr_ros cdpr.launch.py robot:=/path/to/robot.json"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("robot", default_value="caroca"),
            Node(
                package="cdpr_ros",
                executable="cdpr_node",
                name="cdpr",
                parameters=[{"robot": LaunchConfiguration("robot")}],
            ),
        ]
    )
