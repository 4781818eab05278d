//! On which map it is driven: the town of this program, or one that lies in a folder.

use std::path::Path;

use mufasa_sim::map::Town;
use mufasa_sim::map::id::MapId;
use mufasa_sim::map::streets::town;
use mufasa_sim::map::ulm::lehr;

use crate::ended::said;

/// The map of a folder; the town, where none is named.
pub(super) fn of(folder: Option<&Path>) -> Result<Town, String> {
    folder.map_or_else(|| Ok(town()), |folder| lehr(folder).map_err(said))
}

/// As [`of`], for `what` that was made on a map before. Errors: it was another one.
pub(super) fn same(folder: Option<&Path>, id: MapId, what: &str) -> Result<Town, String> {
    let town = of(folder)?;
    if town.id == id {
        return Ok(town);
    }
    let needed = match id {
        MapId::Town => "do not give --map",
        MapId::Lehr(_) => "give the folder of that map by --map",
    };
    Err(format!("{what}: of the map {id}, and this is {}; {needed}", town.id))
}

/// What a command needs to be of this map.
pub(super) const fn option(id: MapId) -> &'static str {
    match id {
        MapId::Town => "",
        MapId::Lehr(_) => " --map FOLDER",
    }
}
