//! A study keeps sums, and of its observations a number that does not grow.

use cdpr_study::{KEPT, Session, Study, analyse, observe};
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

/// The first observations are kept for the report; the counts here are above that.
#[test]
fn memory_does_not_grow_with_the_number_of_observations() {
    let (few, many) = (peak_memory(KEPT + 8_192), peak_memory(2 * KEPT));
    assert!(
        many as f64 <= 1.1 * few as f64,
        "{few} bytes of {} observations, {many} of {}",
        KEPT + 8_192,
        2 * KEPT
    );
}
