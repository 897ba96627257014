//! Groups of inputs in Saltelli's and Morris's designs, and outputs with several components.

use super::functions::{ishigami, morris};
use crate::common::{rows, uniform};
use cdpr_sensitivity::{
    Bootstrap, Group, MorrisDesign, Order, SaltelliDesign, SampleDesign, SensitivityError, morris_effects,
    observe, sobol_indices, vector_sobol_indices,
};

const BOOTSTRAP: Bootstrap = Bootstrap { resamples: 400, seed: 7 };

fn singles(k: usize) -> Vec<Group> {
    (0..k).map(|i| Group::new(format!("x{}", i + 1), [i])).collect()
}

#[test]
fn groups_of_one_input_each_have_the_indices_and_effects_of_the_inputs() {
    let function = morris();
    let design = SaltelliDesign::scrambled(function.inputs.clone(), 64, Order::Second, 1).unwrap();
    let grouped = design.clone().grouped(singles(20)).unwrap();
    assert_eq!(rows(&design, 1), rows(&grouped, 1));
    let outputs = observe(&design, |x| Some((function.model)(x))).unwrap();
    let of = |design| sobol_indices(design, &outputs, BOOTSTRAP, 0.95).unwrap();
    assert_eq!(of(&design), of(&grouped));
    for design in [
        MorrisDesign::radial(function.inputs.clone(), 8, 1).unwrap(),
        MorrisDesign::trajectories(function.inputs.clone(), 8, 4, 1).unwrap(),
    ] {
        let outputs = observe(&design, |x| Some((function.model)(x))).unwrap();
        let grouped = design.clone().grouped(singles(20)).unwrap();
        assert_eq!(rows(&design, 1), rows(&grouped, 1));
        let of = |design| morris_effects(design, &outputs, 0.95).unwrap();
        assert_eq!(of(&design), of(&grouped));
    }
}

#[test]
fn the_index_of_a_group_contains_the_interactions_within_it() {
    let function = ishigami();
    let groups = vec![Group::new("x1 and x3", [0, 2]), Group::new("x2", [1]), Group::new("x1", [0])];
    let design = SaltelliDesign::scrambled(function.inputs, 4096, Order::First, 3).unwrap();
    let design = design.grouped(groups).unwrap();
    assert_eq!((design.block_points(), design.points()), (5, 5 * 4096));
    let outputs = observe(&design, |x| Some((function.model)(x))).unwrap();
    let found = sobol_indices(&design, &outputs, BOOTSTRAP, 0.95).unwrap();
    let (first, total) = (&function.first, &function.total);
    // Nothing but x1 and x3 acts together.
    let together = total[0];
    for (index, exact) in found.inputs.iter().zip([[together; 2], [first[1], total[1]], [first[0], total[0]]])
    {
        for (found, exact) in [index.first, index.total].into_iter().zip(exact) {
            assert!(found.low <= exact && exact <= found.high, "{}: {exact} not in {found:?}", index.input);
            assert!((found.value - exact).abs() < 0.02, "{}: {exact}, {found:?}", index.input);
        }
    }
    assert_eq!(found.inputs[0].input, "x1 and x3");
}

#[test]
fn a_failed_run_of_a_group_is_missed_by_its_indices_alone() {
    let design = SaltelliDesign::scrambled(uniform(3, 0.0, 1.0), 64, Order::First, 3).unwrap();
    let design = design.grouped(vec![Group::new("p", [0, 1]), Group::new("q", [2])]).unwrap();
    let mut outputs = observe(&design, |x| Some(x[0] + x[1] * x[2])).unwrap();
    // The row of the second group in a block of the estimate.
    outputs[2] = None;
    let found = sobol_indices(&design, &outputs, BOOTSTRAP, 0.95).unwrap();
    assert_eq!((found.inputs[0].blocks, found.inputs[1].blocks), (64, 62));
    assert_eq!((found.failed, found.failed_blocks), (1, 1));
}

#[test]
fn the_elementary_effect_of_a_group_is_the_change_when_all_of_it_moves() {
    let model = |x: &[f64]| Some(3.0 * x[0] + 4.0 * x[1] + x[2]);
    let groups = vec![Group::new("p", [0, 1]), Group::new("q", [2])];
    let design = MorrisDesign::trajectories(uniform(4, 0.0, 1.0), 400, 4, 1).unwrap();
    let design = design.grouped(groups.clone()).unwrap();
    assert_eq!((design.blocks(), design.points()), (400, 1200));
    for block in rows(&design, 1).chunks(3) {
        // x4 is in no group.
        assert!(block.iter().all(|row| row[3] == block[0][3]));
    }
    let found = morris_effects(&design, &observe(&design, model).unwrap(), 0.95).unwrap();
    // Half of the moves are in the same direction, |3 + 4|, half are not, |3 - 4|.
    let effect = found[0].mean_absolute;
    assert!(effect.low < 4.0 && 4.0 < effect.high && effect.width() < 0.7, "{effect:?}");
    assert!((found[1].mean_absolute.value - 1.0).abs() < 1e-12);

    let radial = MorrisDesign::radial(uniform(4, 0.0, 1.0), 64, 1).unwrap().grouped(groups).unwrap();
    let found = morris_effects(&radial, &observe(&radial, model).unwrap(), 0.95).unwrap();
    // |3 p + 4 q| over the root mean square of p and q is at most 5 √2.
    assert!(found[0].mean_absolute.value > 3.0 && found[0].mean_absolute.value < 5.0 * 2.0_f64.sqrt());

    // Groups of radial blocks may overlap: each of them moves from the first point.
    let radial = radial.grouped(vec![Group::new("q and r", [2, 3]), Group::new("q", [2])]).unwrap();
    let found = morris_effects(&radial, &observe(&radial, model).unwrap(), 0.95).unwrap();
    assert!(found[0].effects == 64 && found[0].mean_absolute.value < 2.0_f64.sqrt());
    assert!((found[1].mean_absolute.value - 1.0).abs() < 1e-12);
}

#[test]
fn groups_that_do_not_fit_are_refused_by_their_name() {
    let design = |order| SaltelliDesign::scrambled(uniform(3, 0.0, 1.0), 16, order, 1).unwrap();
    let morris = || MorrisDesign::trajectories(uniform(3, 0.0, 1.0), 4, 4, 1).unwrap();
    let twice = || vec![Group::new("p", [0, 1]), Group::new("q", [1])];
    assert!(design(Order::First).grouped(twice()).is_ok());
    assert!(MorrisDesign::radial(uniform(3, 0.0, 1.0), 4, 1).unwrap().grouped(twice()).is_ok());
    for refused in [
        design(Order::Second).grouped(twice()).unwrap_err(),
        morris().grouped(twice()).unwrap_err(),
        design(Order::First).grouped(vec![Group::new("q", [])]).unwrap_err(),
        design(Order::First).grouped(vec![Group::new("q", [3])]).unwrap_err(),
        design(Order::First).grouped(vec![Group::new("q", [1, 1])]).unwrap_err(),
    ] {
        assert!(matches!(&refused, SensitivityError::WrongGroup { name, .. } if name == "q"), "{refused}");
    }
    assert!(matches!(design(Order::First).grouped(vec![]), Err(SensitivityError::OutOfRange { .. })));
}

#[test]
fn indices_of_a_vector_are_shares_of_the_sum_of_its_variances() {
    let design = SaltelliDesign::scrambled(uniform(3, 0.0, 1.0), 1024, Order::Second, 5).unwrap();
    let output = |x: &[f64]| [x[0] + 2.0 * x[1], 3.0 * x[0] - x[2] + 7.0];
    let observed = |turn: f64| -> Vec<Option<Vec<f64>>> {
        rows(&design, 1)
            .iter()
            .map(|row| {
                let [p, q] = output(row);
                Some(vec![turn.cos() * p - turn.sin() * q, turn.sin() * p + turn.cos() * q])
            })
            .collect()
    };
    let found = vector_sobol_indices(&design, &observed(0.0), BOOTSTRAP, 0.95).unwrap();
    // The variance of 2048 independent outputs has a standard deviation of 3 %; theirs are balanced.
    assert!((found.variance * 12.0 / 15.0 - 1.0).abs() < 0.01, "{}", found.variance);
    for (index, exact) in found.inputs.iter().zip([10.0, 4.0, 1.0].map(|part| part / 15.0)) {
        assert!((index.first.value - exact).abs() < 0.01 && (index.total.value - exact).abs() < 0.01);
        assert!(index.first.low <= exact && exact <= index.first.high, "{index:?}");
    }
    // They do not depend on the axes of the output.
    let turned = vector_sobol_indices(&design, &observed(0.7), BOOTSTRAP, 0.95).unwrap();
    for (index, turned) in found.inputs.iter().zip(&turned.inputs) {
        assert!((index.first.value - turned.first.value).abs() < 1e-12);
        assert!((index.total.low - turned.total.low).abs() < 1e-9);
    }
}

#[test]
fn a_vector_of_one_component_has_the_indices_of_a_number() {
    let function = ishigami();
    let design = SaltelliDesign::scrambled(function.inputs, 128, Order::First, 1).unwrap();
    let mut outputs = observe(&design, |x| Some((function.model)(x))).unwrap();
    (outputs[3], outputs[17]) = (None, None);
    let number = sobol_indices(&design, &outputs, BOOTSTRAP, 0.95).unwrap();
    let one: Vec<_> = outputs.iter().map(|output| output.map(|y| vec![y])).collect();
    assert_eq!(number, vector_sobol_indices(&design, &one, BOOTSTRAP, 0.95).unwrap());
    // A component that does not vary adds nothing.
    let two: Vec<_> = outputs.iter().map(|output| output.map(|y| vec![5.0, y])).collect();
    let two = vector_sobol_indices(&design, &two, BOOTSTRAP, 0.95).unwrap();
    assert!((two.inputs[1].total.value - number.inputs[1].total.value).abs() < 1e-14);
    let mut ragged = one;
    ragged[5] = Some(vec![1.0, 2.0]);
    let refused = vector_sobol_indices(&design, &ragged, BOOTSTRAP, 0.95).unwrap_err();
    assert!(matches!(refused, SensitivityError::LengthMismatch { field: "components", .. }), "{refused}");
}
