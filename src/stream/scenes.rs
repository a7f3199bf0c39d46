//! Finds the scene of a sample.

use std::collections::VecDeque;
use std::hash::{DefaultHasher, Hash, Hasher};

use super::{Sample, Scene};
use crate::error::{Error, Result};

/// A record takes as many places as its line has multiples of this many bytes.
pub(super) const PLACE_BYTES: usize = 1 << 20;
/// Number of scenes kept for samples to refer to, if none is larger than [`PLACE_BYTES`]; a larger one takes
/// several places.
const PLACES_MAX: usize = 64;

const REMEDY: &str = "put the line of its scene above it";

/// The preceding scene and as many earlier ones as memory allows, each with a tool's data on it.
///
/// A sample names its scene in the field `scene`, and need not follow it immediately: records may be grouped
/// by kind. A sample that names none belongs to the preceding scene.
///
/// # Example
/// ```
/// use vfold::stream::{Fields, Sample, Scene, Scenes};
/// let scene = |id: &str, angle_deg: f64| -> vfold::Result<Scene> {
///     let mut fields = Fields::default();
///     fields.set("format", "vfold/1")?;
///     fields.set("id", id)?;
///     fields.set("angle_deg", angle_deg)?;
///     Scene::from_fields(fields)
/// };
/// let mut scenes = Scenes::default();
/// scenes.enter(&scene("shade", 45.0)?, 'a');
/// scenes.enter(&scene("sun", 50.0)?, 'b');
/// assert_eq!(scenes.of(&Sample::new("shade", "one")?)?, Some(&'a'));
/// assert_eq!(scenes.of(&Sample::new("sun", "two")?)?, Some(&'b'));
/// assert!(scenes.of(&Sample::new("dusk", "three")?).is_err());
/// # Ok::<(), vfold::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scenes<T> {
    /// The latest is last.
    above: VecDeque<Above<T>>,
    /// Incremented with every sample: scenes that differ in it have samples between them.
    run: u64,
    has_forgotten: bool,
}

/// A preceding scene.
#[derive(Clone, Debug)]
struct Above<T> {
    id: Option<String>,
    what: T,
    places: usize,
    /// Distinguishes it from another scene of the same name.
    mark: u64,
    run: u64,
    is_ambiguous: bool,
}

impl<T> Default for Scenes<T> {
    fn default() -> Self {
        Self { above: VecDeque::new(), run: 0, has_forgotten: false }
    }
}

impl<T> Scenes<T> {
    /// Adds a scene and the data on it, replacing an earlier one of the same name.
    pub fn enter(&mut self, scene: &Scene, what: T) {
        let id = scene.fields.text_at("id").ok().flatten();
        let (mut bytes, mut mark) = (0, DefaultHasher::new());
        for name in scene.fields.names() {
            let text = scene.fields.text(name).unwrap_or_default();
            bytes += name.len() + text.len();
            if name != "history" {
                (name, text).hash(&mut mark);
            }
        }
        let (places, mark, run) = (1 + bytes / PLACE_BYTES, mark.finish(), self.run);
        // one without a name can be referred to only while it is the last
        if self.above.back().is_some_and(|last| last.id.is_none()) {
            self.above.pop_back();
        }
        let of_its_name = self.above.iter().position(|above| above.id == id && id.is_some());
        let former = of_its_name.and_then(|place| self.above.remove(place));
        // samples below could belong to either of the two
        let is_ambiguous =
            former.is_some_and(|former| former.run == run && (former.mark != mark || former.is_ambiguous));
        self.above.push_back(Above { id, what, places, mark, run, is_ambiguous });
        while self.above.len() > 1 && self.above.iter().map(|above| above.places).sum::<usize>() > PLACES_MAX
        {
            self.above.pop_front();
            self.has_forgotten = true;
        }
    }

    /// The data on a sample's scene; none if no scene precedes it.
    ///
    /// # Errors
    /// [`Error::Field`] if the sample names a scene that is not kept, or one of two with the same name.
    pub fn of(&mut self, sample: &Sample) -> Result<Option<&T>> {
        self.run += 1;
        let Some(last) = self.above.back() else { return Ok(None) };
        let Some(id) = sample.fields.text_at("scene")? else { return Ok(Some(&last.what)) };
        let Some(found) = self.above.iter().rev().find(|above| above.id.as_ref() == Some(&id)) else {
            let above = last.id.as_deref().map_or("one without a name".to_owned(), |id| format!("'{id}'"));
            let problem = match self.has_forgotten {
                true => {
                    format!("'{id}' is not among the scenes that are kept, the last {}", self.above.len())
                }
                false => format!("no scene '{id}' comes before the sample; the scene above it is {above}"),
            };
            return Err(Error::field("scene", format!("{problem}; {REMEDY}")));
        };
        if found.is_ambiguous {
            let problem = format!("two scenes above the sample are called '{id}': it may belong to either");
            return Err(Error::field(
                "scene",
                format!("{problem}; {REMEDY}, or name scenes with vkernel --id"),
            ));
        }
        Ok(Some(&found.what))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::Fields;

    fn scene(id: &str, text: &str) -> Scene {
        let mut fields = Fields::default();
        fields.set("format", "vfold/1").unwrap();
        fields.set("id", id).unwrap();
        fields.set("text", text).unwrap();
        Scene::from_fields(fields).unwrap()
    }

    fn sample(scene: &str) -> Sample {
        Sample::new(scene, "sample").unwrap()
    }

    fn problem(scenes: &mut Scenes<usize>, id: &str) -> String {
        scenes.of(&sample(id)).unwrap_err().to_string()
    }

    #[test]
    fn a_sample_without_a_name_is_of_the_scene_above_it() {
        let mut scenes = Scenes::default();
        let nameless = Sample { fields: Fields::default() };
        assert_eq!(scenes.of(&nameless).unwrap(), None);
        scenes.enter(&scene("a", ""), 1);
        scenes.enter(&scene("b", ""), 2);
        assert_eq!(scenes.of(&nameless).unwrap(), Some(&2));
        assert!(problem(&mut scenes, "c").contains("'b'"));
    }

    #[test]
    fn scenes_of_one_name_follow_each_other_unless_nothing_parts_them() {
        let mut scenes = Scenes::default();
        for n in 0..3 {
            scenes.enter(&scene("fold", &n.to_string()), n);
            assert_eq!(scenes.of(&sample("fold")).unwrap(), Some(&n));
        }
        scenes.enter(&scene("fold", "x"), 3);
        scenes.enter(&scene("fold", "x"), 4);
        assert_eq!(scenes.of(&sample("fold")).unwrap(), Some(&4), "the same scene twice");
        scenes.enter(&scene("fold", "x"), 5);
        scenes.enter(&scene("fold", "y"), 6);
        assert!(problem(&mut scenes, "fold").contains("two scenes"));
        assert!(problem(&mut scenes, "fold").contains("two scenes"));
        scenes.enter(&scene("fold", "z"), 7);
        assert_eq!(scenes.of(&sample("fold")).unwrap(), Some(&7));
    }

    #[test]
    fn memory_is_bounded() {
        let mut scenes = Scenes::default();
        for n in 0..100 {
            scenes.enter(&scene(&n.to_string(), ""), n);
        }
        assert_eq!(scenes.of(&sample("36")).unwrap(), Some(&36));
        assert!(problem(&mut scenes, "35").contains("the last 64"));
        let large = "x".repeat(40 * PLACE_BYTES);
        scenes.enter(&scene("large", &large), 100);
        scenes.enter(&scene("larger", &large), 101);
        assert_eq!(scenes.of(&sample("larger")).unwrap(), Some(&101));
        assert!(problem(&mut scenes, "large").contains("the last 1"));
    }

    #[test]
    fn many_fields_are_as_large_as_one() {
        let mut scenes = Scenes::default();
        scenes.enter(&scene("small", ""), 0);
        let mut large = scene("large", "");
        for n in 0..2 * PLACES_MAX {
            large.fields.set(&n.to_string(), "x".repeat(PLACE_BYTES / 2)).unwrap();
        }
        scenes.enter(&large, 1);
        assert!(problem(&mut scenes, "small").contains("the last 1"));
    }

    #[test]
    fn scenes_without_names_take_no_places() {
        let mut scenes = Scenes::default();
        scenes.enter(&scene("named", ""), 0);
        let mut nameless = scene("", "");
        nameless.fields.set("id", None::<&str>).unwrap();
        for n in 1..=2 * PLACES_MAX {
            scenes.enter(&nameless, n);
        }
        assert_eq!(scenes.of(&sample("named")).unwrap(), Some(&0));
        assert_eq!(scenes.of(&Sample { fields: Fields::default() }).unwrap(), Some(&(2 * PLACES_MAX)));
    }
}
