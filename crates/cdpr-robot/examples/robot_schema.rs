//! Writes the JSON Schemas of the robot file and the cable file to `docs/schemas/` of the repository.

fn main() -> std::io::Result<()> {
    let schemas = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas");
    std::fs::write(format!("{schemas}/cdpr-robot-1.schema.json"), cdpr_robot::json_schema())?;
    std::fs::write(format!("{schemas}/cdpr-cable-1.schema.json"), cdpr_robot::cable_schema())
}
