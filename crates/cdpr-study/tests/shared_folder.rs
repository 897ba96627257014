//! A study shared by processes: they begin in one folder at once, and each knows how much its share is.

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
                    begin(&out, &study, Existing::Share).map(|_| ())
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
fn a_folder_is_gone_on_with_whatever_another_process_has_put_there_so_far_or_is_seen_of_it() {
    let study = study();
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("results");
    begin(&out, &study, Existing::GoOn).unwrap();
    // A network disk may show what is there late.
    for hidden in [&["blocks"][..], &["study.json"], &["study.json", "robot.json"], &["blocks", "study.json"]]
    {
        for name in hidden {
            let path = out.join(name);
            let removed = if path.is_dir() { std::fs::remove_dir(path) } else { std::fs::remove_file(path) };
            removed.unwrap();
        }
        begin(&out, &study, Existing::GoOn).unwrap();
        assert!(["blocks", "study.json", "robot.json"].iter().all(|name| out.join(name).exists()));
    }
    // Where a user's own file is in the way, nothing is written beside it.
    let unwritten = folder.path().join("unwritten");
    std::fs::create_dir(&unwritten).unwrap();
    std::fs::write(unwritten.join("blocks"), "in the way").unwrap();
    begin(&unwritten, &study, Existing::GoOn).unwrap_err();
    assert_eq!(std::fs::read_to_string(unwritten.join("blocks")).unwrap(), "in the way");
    let written = ["cdpr-results.json", "robot.json", "study.json"].map(|name| unwritten.join(name).exists());
    assert_eq!(written, [false; 3]);
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
    // The points with derivatives behind the verdict are not kept: the analysis makes them.
    assert_eq!(sum + 256, all);
}
