//! Small files of other programs, with the numbers of the robots that they come from.

use cdpr_exchange::{ExchangeError, ForeignFile, ImportOptions, Imported, NoteKind, import};
use cdpr_robot::library::{CABLES, named};
use cdpr_robot::{CatalogueCable, TensionLimits};

/// Bodies of CoGiRo as in CASPR.
pub(crate) const BODIES: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE bodies_system SYSTEM "../../../../templates/bodies.dtd">
<bodies_system>
  <links display_range="-8 8 -6 6 0 6" view_angle="-37 32">
    <link_rigid num="1" name="CoGiRo">
      <joint type="SPATIAL_EULER_XYZ" q_initial="0 0 2.0 0 0 0"/>
      <physical>
        <mass>91.058</mass>
        <com_location>-0.034 -0.013 0.264</com_location>
        <end_location>0.0 0.0 0.0</end_location>
        <inertia ref="com">
          <Ixx>36.598</Ixx> <Iyy>35.982</Iyy> <Izz>25.439</Izz>
          <Ixy>-0.453</Ixy> <Ixz>3.012</Ixz> <Iyz>-1.539</Iyz>
        </inertia>
      </physical>
      <parent> <num>0</num> <location>0.0 0.0 0.0</location> </parent>
    </link_rigid>
  </links>
</bodies_system>
"#;

/// Two cables, one over a pulley of CAROCA's, one between points, and a set of springs.
pub(crate) const CABLES_OF_CASPR: &str = concat!(
    r#"<cables default_cable_set="pulleys">
  <cable_set id="pulleys">
    <cable_ideal name="1" attachment_reference="joint">
      <properties> <force_min>0</force_min> <force_max>1000</force_max> </properties>
      <attachments>
        <base_rotating_pulley>
          <fixed_location>1.659 -2.850 3.221</fixed_location>
          <pulley_radius>0.045</pulley_radius>
          <cable_entry_vector>0 0 1</cable_entry_vector>
        </base_rotating_pulley>
        <attachment> <link>1</link> <location>0.16 0.14 0.105</location> </attachment>
      </attachments>
    </cable_ideal>
    <cable_ideal name="2" attachment_reference="com">
      <properties> <force_min>5</force_min> <force_max>800</force_max>"#,
    r#" <diameter>0.004</diameter> </properties>
      <attachments>
        <attachment> <link>0</link> <location>1.350 -3.159 3.221</location> </attachment>
        <attachment> <link>1</link> <location>-0.13 -0.21 -0.105</location> </attachment>
      </attachments>
    </cable_ideal>
  </cable_set>
  <cable_set id="springs">
    <cable_linear_spring name="1" attachment_reference="joint">
      <properties> <K>350000</K> <force_min>1</force_min> <force_max>1000</force_max> </properties>
      <attachments>
        <attachment> <link>0</link> <location>1.350 -3.159 3.221</location> </attachment>
        <attachment> <link>1</link> <location>-0.13 -0.21 -0.105</location> </attachment>
      </attachments>
    </cable_linear_spring>
  </cable_set>
</cables>
"#
);

/// Two chains: one with a tilted axis, one of WireX's template.
pub(crate) const WIREX: &str = concat!(
    r#"<models version="0.31">
  <robot name="CoGiRo" author="Fraunhofer IPA" description="of the template" motionpattern="3R3T">
    <geometry>
      <chain id="1" winchtype="IPAnema-Winde">
        <base x="-7.175" y="-5.244" z="5.462" a11="1" a21="0" a31="0""#,
    r#" a12="0" a22="0" a32="1" a13="0.6" a23="0" a33="0.8" radius="0.1"/>
        <platform x="0.503" y="-0.493" z="0" a11="1" a33="1"/>
      </chain>
      <chain id="2" winchtype="IPAnema-Winde">
        <base x="7.2398" y="5.3759" z="5.4093" a13="0" a23="0" a33="1" radius="0.1"/>
        <platform x="-0.5" y="0.35" z="0.9976"/>
      </chain>
    </geometry>
    <platform name="default" mass="25" swing_angle="50">
      <inertiatensor Ixx="14"/> <centerofgravity x="0" y="1" z="0.2"/>
    </platform>
    <controller ipo_clock="4"/>
  </robot>
  <cable name="defaultCable" elasticity="110000000000" radius="0.006""#,
    r#" breaking_load="40000" damping="1" weight="0.023" minimum_load="0"/>
  <winch name="IPAnema-Winde">"#,
    r#" <cable nr_cables="1" f_max="720" spring_constant="0"/> <drum r_drum="0.1"/> </winch>
</models>
"#
);

/// The whole robot of oKermorgant's cdpr.
pub(crate) const YAML: &str = include_str!("../../../data/reference/exchange/caroca.yaml");

/// Two actuators of GRAB, one of them not active, with the commas that trail.
pub(crate) const IRMA: &str = r#"{
  "motion_pattern": "THREE_R_THREE_T",
  "actuator": [
    {"active": true,
     "pulley": {"radius": 0.022482, "pos_OD_glob": [[0.219474], [-1.316231], [0.527150]],
                "vers_k": [[-0.999761], [-0.017613], [-0.012977]],},
     "winch": {"l0": 1, "pos_PA_loc": [[-0.143574], [-0.219372], [0.264012]]}},
    {"active": false, "pulley": {}, "winch": {}},
  ],
  "platform": {"mass": 1, "gravity_axis": [[0.0086989], [-0.0058238], [0.9999452]],
    "inertia_mat_G_loc": [[0.0167263, 0.0007345, 0.0002582], [0.0007345, 0.0226805, -0.0006856],
                          [0.0002582, -0.0006856, 0.0325219]],
    "pos_PG_loc": [[0.0017598], [-0.0023415], [0.1997412]],}
}
"#;

/// A table of points with a pulley in its first line.
pub(crate) const TABLE: &str =
    "exit_x,exit_y,exit_z,anchor_x,anchor_y,anchor_z,radius,axis_x,axis_y,axis_z,colour
-2,-1.5,3,0.2,-0.1,0,0.03,0,0,-1,red
2,1.5,3,-0.2,0.1,0,,,,,blue
";

pub(crate) fn file(name: &str, text: &str) -> ForeignFile {
    ForeignFile { name: name.to_owned(), text: text.to_owned() }
}

/// A cable of the catalogue.
pub(crate) fn catalogue(name: &str) -> CatalogueCable {
    CatalogueCable::from_json(named(CABLES, name).unwrap().text).unwrap()
}

/// What files lack.
pub(crate) fn options() -> ImportOptions {
    ImportOptions { cable: Some(catalogue("steel-4mm")), ..ImportOptions::default() }
}

/// Mass and limits of tension, too.
pub(crate) fn all_options() -> ImportOptions {
    let tension_limits = Some(TensionLimits { min: 1.0, max: 500.0 });
    ImportOptions { mass: Some(12.0), tension_limits, ..options() }
}

pub(crate) fn imported(files: &[(&str, &str)], options: &ImportOptions) -> Result<Imported, ExchangeError> {
    let files: Vec<_> = files.iter().map(|(name, text)| file(name, text)).collect();
    import(&files, options)
}

/// A file of `data/reference/exchange`.
pub(crate) fn reference(name: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/reference/exchange");
    std::fs::read_to_string(format!("{folder}/{name}")).unwrap()
}

/// The notes of a kind.
pub(crate) fn notes(found: &Imported, kind: NoteKind) -> Vec<String> {
    found.notes.iter().filter(|note| note.kind == kind).map(|note| note.text.clone()).collect()
}
