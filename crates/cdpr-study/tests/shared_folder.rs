//! A study shared by processes: they begin in one folder at once, and each knows how much its share is.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use cdpr_study::{Existing, Plan, Session, Shard, Study, begin, observe_shard};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Barrier;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A sampling of CAROCA over a plane, of which few poses are held, and one at a pose with replicates.
fn study() -> Study {
    let data = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies"));
    let path = data.join("caroca-poses.json");
    let mut study: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let plane = &mut study["samplings"]["plane"];
    plane["observations"] = json!(10);
    let mut alone = plane.clone();
    alone.as_object_mut().unwrap().remove("poses");
    alone["pose"] = json!({"position": [0.0, 0.0, 1.75]});
    study["samplings"]["alone"] = alone;
    study["replicates"] = json!(2);
    Study::from_json(&study.to_string(), &path).unwrap()
}

#[test]
fn any_number_of_processes_may_begin_in_a_new_folder_at_once() {
    let study = study();
    for round in 0..50 {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("results");
        let begun = Barrier::new(8);
        std::thread::scope(|scope| {
            let threads = [(); 8].map(|()| {
                scope.spawn(|| {
                    begun.wait();
                    begin(&out, &study, Existing::GoOn).map(|_| ())
                })
            });
            for thread in threads {
                let result = thread.join().unwrap();
                assert!(result.is_ok(), "round {round}: {result:?}");
            }
        });
    }
}

#[test]
fn the_observations_of_a_shard_are_those_that_it_ticks() {
    let study = study();
    let plan = Plan::new(&study).unwrap();
    let all: usize = study.file.samplings.keys().map(|name| study.observations(name).unwrap()).sum();
    let mut sum = 0;
    for index in 1..=3 {
        let shard = Shard::parse(&format!("{index}/3"), |_| None).unwrap();
        let done = AtomicUsize::new(0);
        let tick = |more: usize| {
            done.fetch_add(more, Ordering::Relaxed);
        };
        observe_shard(&study, shard, &Session { tick: &tick, ..Session::in_memory() }).unwrap();
        let expected = plan.observations(shard);
        assert_eq!(done.into_inner(), expected);
        assert!(expected > all / 6, "{expected} of {all}");
        sum += expected;
    }
    assert_eq!(sum, all);
}
