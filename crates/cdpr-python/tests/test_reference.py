"""Cables, equilibria and Sobol's points against data/reference, with the bounds of the Rust tests."""

import json

import numpy

import cdpr
from cdpr.sensitivity import SobolDesign, uniform


def read(data, name):
    return json.loads((data / "reference" / name).read_text())


def column(cases, name):
    return numpy.array([case[name] for case in cases], dtype=float)


def test_end_forces_match_40_digit_arithmetic(data):
    cases = read(data, "catenary.json")
    assert len(cases) == 64
    ends = numpy.stack([column(cases, "x"), column(cases, "z")], axis=1)
    cables = cdpr.catenary(
        column(cases, "weight_per_length"),
        column(cases, "axial_stiffness"),
        length=column(cases, "unstrained_length"),
        end=ends,
    )
    forces = numpy.stack([column(cases, "force_x"), column(cases, "force_z")], axis=1)
    relative = numpy.linalg.norm(cables.force - forces, axis=1) / numpy.linalg.norm(forces, axis=1)
    # The stretch of a stiff cable is itself known to fewer digits.
    known = numpy.array([case["kind"] != "stiff_light" for case in cases])
    assert relative[known].max() <= 1e-10
    assert cables.reasons == [None] * 64
    numpy.testing.assert_allclose(cables.shape[:, -1], ends, atol=1e-11)


def test_equilibria_match_40_digit_arithmetic(data):
    cases = read(data, "equilibria.json")
    assert len(cases) == 24
    for case in cases:
        robot = cdpr.Robot(
            case["anchor_points"],
            case["exit_points"],
            mass=case["mass"],
            center_of_mass=case["center_of_mass"],
            section=1.0,
            linear_density=case["weight_per_length"] / case["gravity"],
            youngs_modulus=case["axial_stiffness"],
            tension_limits=(1.0, 1e6),
            gravity=case["gravity"],
        )
        start = [*case["start_position"], *quaternion(numpy.array(case["start_rotation"], dtype=float))]
        found = robot.direct(
            case["unstrained_lengths"],
            force=case["external_force"],
            moment=case["external_moment"],
            start=start,
        )
        position = numpy.array(case["position"], dtype=float)
        rotation = numpy.array(case["rotation"], dtype=float)
        assert numpy.linalg.norm(found.position - position) < 1e-9, case["kind"]
        assert numpy.linalg.norm(found.rotation - rotation) < 1e-9, case["kind"]
        forces = numpy.array([case["cable_force_horizontal"], case["cable_force_vertical"]], dtype=float).T
        assert numpy.linalg.norm(found.cable_forces - forces, axis=1).max() < 1e-6, case["kind"]


def quaternion(rotation):
    """(w, x, y, z) of a matrix without a half turn."""
    w = 0.5 * numpy.sqrt(1.0 + numpy.trace(rotation))
    turned = rotation - rotation.T
    return numpy.array([w, *(numpy.array([turned[2, 1], turned[0, 2], turned[1, 0]]) / (4.0 * w))])


def test_sobol_points_are_those_of_scipy_bit_for_bit(data):
    points = read(data, "sobol.json")["points"]
    for dimensions in {point["dimensions"] for point in points}:
        wanted = [point for point in points if point["dimensions"] == dimensions]
        inputs = {f"x{k}": uniform(0.0, 1.0) for k in range(dimensions)}
        for point in wanted:
            row = SobolDesign(inputs, 1, first_index=point["index"]).rows()[0]
            numpy.testing.assert_array_equal(row, numpy.array(point["numerators"]) / 2.0**30)
