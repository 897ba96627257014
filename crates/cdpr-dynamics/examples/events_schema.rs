//! Writes the JSON Schema of the events of a motion to `docs/schemas/` of the repository.

fn main() -> std::io::Result<()> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas");
    let schema = cdpr_dynamics::simulate::events_schema();
    std::fs::write(format!("{folder}/cdpr-events-1.schema.json"), schema)
}
