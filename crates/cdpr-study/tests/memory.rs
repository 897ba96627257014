//! A study keeps sums and no observations.

use cdpr_study::{Session, Study, analyse, observe};
use std::path::Path;

/// Most memory at a time of a sampling with this many observations, on one thread [bytes].
fn peak_memory(observations: usize) -> u64 {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/studies/caroca.json");
    let mut study = Study::open(&path).unwrap();
    study.set_observations(observations).unwrap();
    study.file.replicates = 0;
    study.file.sensitivity = None;
    let sampling = study.sampling("mechanical").unwrap();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    // Allocations are counted thread by thread.
    let allocated = pool.install(|| {
        allocation_counter::measure(|| {
            let session = Session::in_memory();
            let tally = observe(&sampling, &session).unwrap();
            assert!(analyse(&sampling, &tally, &session).unwrap().values.is_some());
        })
    });
    allocated.bytes_max
}

#[test]
fn memory_does_not_grow_with_the_number_of_observations() {
    let (few, many) = (peak_memory(20_000), peak_memory(80_000));
    assert!(many as f64 <= 2.0 * few as f64, "{few} bytes of 20 000 observations, {many} of 80 000");
}
