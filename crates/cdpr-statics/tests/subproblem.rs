//! The subproblem of the trust region, whose file this compiles by itself.

#[path = "../src/direct/subproblem.rs"]
mod source;

use nalgebra::{Matrix6, Vector6};
use source::subproblem;

#[test]
fn the_subproblem_is_newtons_step_inside_and_steepest_at_the_edge() {
    let hessian = Matrix6::from_diagonal(&Vector6::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
    let gradient = Vector6::new(1.0, -2.0, 3.0, -4.0, 5.0, -6.0);
    let (inside, gain) = subproblem(&gradient, &hessian, 10.0);
    assert!((inside - Vector6::new(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0)).norm() < 1e-12);
    assert!((gain - 10.5).abs() < 1e-12);
    let (edge, _) = subproblem(&gradient, &hessian, 1e-3);
    assert!((edge.norm() - 1e-3).abs() <= 1e-6);
    assert!((edge.normalize() + gradient.normalize()).norm() < 1e-2);
}

#[test]
fn negative_curvature_leads_to_the_edge_even_without_slope() {
    let hessian = Matrix6::from_diagonal(&Vector6::new(-1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
    let (step, gain) = subproblem(&Vector6::zeros(), &hessian, 0.5);
    assert!((step.norm() - 0.5).abs() < 1e-9 && (step.x.abs() - 0.5).abs() < 1e-9);
    assert!((gain - 0.125).abs() < 1e-9);
}
