//! The manifest of a pack.

use serde::{Deserialize, Serialize};

/// Version of the layout; a pack with another one is refused.
pub const SCHEMA: u32 = 2;

/// Name of the manifest.
pub const MANIFEST: &str = "manifest.json";

/// The manifest of a pack.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Always `wheatstone-vectors`.
    pub format: String,
    /// Version of the layout.
    pub schema: u32,
    /// Program that wrote it.
    pub generator: String,
    /// Unit or system.
    pub target: String,
    /// Verilog module.
    pub module: String,
    /// Name of the vectors.
    pub case: String,
    /// `random`, `directed` or `scene`.
    pub stimulus: String,
    /// Seed of random vectors; 0 where nothing is random.
    pub seed: u64,
    /// Named set of build parameters that the others are changes of.
    pub config: String,
    /// All build parameters, as the command line names them.
    pub build: Vec<Setting>,
    /// Verilog parameters.
    pub parameters: Vec<Value>,
    /// Static inputs.
    pub statics: Vec<Value>,
    /// Flags when everything has drained.
    pub flags: Vec<Value>,
    /// The memory that gave the answers to a system's reads, before the first of them.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub frames: Option<FrameBuffers>,
    /// The scene that the vectors are of.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub scene: Option<SceneOrigin>,
    /// BLAKE3 of the Verilog that the vectors match.
    pub rtl_blake3: String,
    /// The streams.
    pub ports: Vec<Port>,
    /// Files that replay the pack, with their hashes.
    pub bench: Vec<HashedFile>,
    /// BLAKE3 of the manifest as compact JSON with this field empty: no field changes unnoticed.
    pub hash: String,
}

impl Manifest {
    /// The value that the field `hash` must have.
    pub fn digest(&self) -> String {
        let emptied = Manifest { hash: String::new(), ..self.clone() };
        // Text and numbers cannot fail to be written.
        let json = serde_json::to_vec(&emptied).unwrap_or_default();
        blake3::hash(&json).to_hex().to_string()
    }

    /// Beats of all streams.
    pub fn beats(&self) -> u64 {
        self.ports.iter().map(|port| port.beats).sum()
    }

    /// The streams that are compared.
    pub fn outputs(&self) -> impl Iterator<Item = &Port> {
        self.ports.iter().filter(|port| port.direction == "output")
    }

    /// Beats that are compared.
    pub fn compared(&self) -> u64 {
        self.outputs().map(|port| port.beats).sum()
    }

    /// True if there is nothing that could differ but a beat too many.
    pub fn is_vain(&self) -> bool {
        self.compared() == 0 && self.flags.is_empty()
    }

    /// Says which outputs have no beats to compare; nothing where all have some.
    pub fn uncompared(&self) -> Option<String> {
        if self.compared() == 0 {
            return Some("no output beat to compare, flags alone".into());
        }
        let empty = self.outputs().filter(|port| port.beats == 0).map(|port| port.name.as_str());
        let names = empty.collect::<Vec<_>>().join(" and ");
        (!names.is_empty()).then(|| format!("no beat of {names} to compare"))
    }
}

/// A name and a number.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Value {
    /// Name of the parameter or port.
    pub name: String,
    /// Its value.
    pub value: u64,
}

/// A name and a choice, or a number that may have a fraction.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setting {
    /// Name, as on the command line or in a rig file.
    pub name: String,
    /// Its value.
    pub value: String,
}

/// Frame buffers beside a system: one for each eye, cleared.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrameBuffers {
    /// Columns of each.
    pub width: u32,
    /// Rows of each.
    pub height: u32,
    /// Clear colour: red, green, blue.
    pub colour: [u8; 3],
    /// Clear depth.
    pub depth: u32,
    /// Part of the left and of the right one that takes pixels: first column and the one behind the
    /// last, first row and the one behind the last.
    pub open: [[u32; 4]; 2],
    /// Pixels with `blended` 1 have passed the depth test already.
    pub tested: bool,
}

/// The scene that vectors are of, and what was done with it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneOrigin {
    /// Name of a built-in scene, or file.
    pub name: String,
    /// BLAKE3 of the file.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub file_blake3: Option<String>,
    /// BLAKE3 of the snapped polygons and the textures: the same if and only if the same is drawn.
    pub polygons_blake3: String,
    /// Columns of each view.
    pub width: u32,
    /// Rows of each view.
    pub height: u32,
    /// Name of the projection.
    pub projection: String,
    /// Lengths and angles of the rig, as its file names them.
    pub rig: Vec<Setting>,
    /// The text of the rig file, if there was one, without blanks: placement, light and all else.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub rig_file: Option<String>,
    /// Ranges of distances that are drawn: from and to in the scene, perceived from and to.
    pub ranges: Vec<[String; 4]>,
    /// Options of the run.
    pub options: Vec<Setting>,
    /// Polygons whose beats are in the pack, in the order of drawing.
    pub polygons: u64,
    /// Polygons of the whole scene.
    pub polygons_of: u64,
    /// Beats of the primary pipeline for these polygons.
    pub beats: u64,
    /// Beats of the primary pipeline for the whole scene: more if it was cut.
    pub beats_of: u64,
}

/// A file and what its content must hash to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HashedFile {
    /// Name in the pack's folder.
    pub file: String,
    /// BLAKE3 of the content.
    pub blake3: String,
}

/// A stream of the module.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Port {
    /// Prefix of the Verilog ports.
    pub name: String,
    /// `input` is driven, `output` is expected.
    pub direction: String,
    /// For a response: beat n may be offered once beat n of this stream was taken.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub answers: Option<String>,
    /// Number of beats.
    pub beats: u64,
    /// Bits of a packed beat.
    pub bits: u32,
    /// Bytes of a beat in the binary file.
    pub bytes: u32,
    /// Hexadecimal beats, for `$readmemh`.
    pub mem: HashedFile,
    /// Binary beats.
    pub bin: HashedFile,
    /// CRC-32/ISO-HDLC of the binary file, eight hexadecimal digits.
    pub crc32: String,
    /// Places of the fields.
    pub fields: Vec<PackedField>,
}

/// A field of a packed beat.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackedField {
    /// Name, the rest of the Verilog port's.
    pub name: String,
    /// Lowest bit in the beat.
    pub lsb: u32,
    /// Width.
    pub bits: u32,
    /// Two's complement.
    pub signed: bool,
    /// Fraction bits.
    pub fraction: u32,
    /// Meaning.
    pub doc: String,
}
