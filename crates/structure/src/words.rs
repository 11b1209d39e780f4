//! Words that modelers and plant libraries name their parts by, and what they say of a role.

use foliar_schema::Role;

/// Weight of a word that names the thing itself.
const NAMED: f64 = 4.0;
/// Weight of a word that usually goes with a role.
const LIKELY: f64 = 3.0;
/// Weight of a word that leans to a role: twigs and branches are wood, or cards that show leaves.
const LEANING: f64 = 1.0;

/// English, German, French, Spanish, Italian, Portuguese, Dutch, Latin, then codes of plant libraries
/// (XFrog: lef, brk, twg, flr, frt). Lower case, without accents.
const WORDS: &[(Role, f64, &str)] = &[
    (
        Role::Leaf,
        NAMED,
        "leaf leaves leafs foliage needle needles frond fronds petal petals flower flowers blossom blossoms bloom \
         fruit fruits berry berries blatt blaetter blatter laub nadel nadeln bluete blueten blute bluten frucht \
         fruechte feuille feuilles feuillage aiguilles fleur fleurs hoja hojas follaje flor flores fruta frutas \
         foglia foglie fogliame aghi fiore fiori frutto frutti folha folhas folhagem blad bladeren naalden bloem \
         bloemen vrucht folium folia flos fructus lef flr frt",
    ),
    (Role::Leaf, LIKELY, "crown canopy krone couronne copa chioma kruin corona leafcard leafcards"),
    (
        Role::Wood,
        NAMED,
        "bark trunk trunks wood bole rinde borke stamm staemme stamme holz ecorce tronc troncs bois corteza tronco \
         troncos madera corteccia legno casca madeira schors hout cortex truncus lignum brk",
    ),
    (Role::Wood, LIKELY, "stem stems stengel tige tiges tallo stelo caule caulis stam log"),
    (
        Role::Wood,
        LEANING,
        "branch branches limb limbs bough boughs twig twigs root roots ast aeste aste zweig zweige wurzel wurzeln \
         branche rameau rameaux racine rama ramas ramo rami raiz galho galhos radice tak takken twijg twijgen wortel \
         ramus radix twg",
    ),
    (
        Role::Other,
        NAMED,
        "glass vase pot pots planter flowerpot blumentopf topf soil dirt ground terrain floor rock rocks stone stones \
         water fence collision collider ucx verre sol vaso maceta suelo terreno suolo boden erde glas grond",
    ),
    (Role::Other, LEANING, "grass moss snow shadow"),
];

/// A word at least this long counts inside a compound too ("eichenblatt", "leafcard").
const COMPOUND: usize = 5;

/// What one name says: role, weight and the word that said it, at most one per role (the strongest).
pub(crate) fn read_name(name: &str) -> Vec<(Role, f64, &'static str)> {
    let tokens = tokens(name);
    let mut found: Vec<(Role, f64, &'static str)> = Vec::new();
    for &(role, weight, words) in WORDS {
        let word = words.split_whitespace().find(|word| tokens.iter().any(|token| says(token, word)));
        if let Some(word) = word
            && !found.iter().any(|f| f.0 == role)
        {
            found.push((role, weight, word));
        }
    }
    found
}

/// A token is the word, or a compound with it that is no listed word itself ("flowerpot").
fn says(token: &str, word: &str) -> bool {
    let compound = word.len() >= COMPOUND && (token.starts_with(word) || token.ends_with(word));
    token == word || (compound && !WORDS.iter().any(|w| w.2.split_whitespace().any(|listed| listed == token)))
}

/// Words of a name: split at everything but letters and where a small letter meets a capital;
/// lower case, accents taken off.
fn tokens(name: &str) -> Vec<String> {
    let mut tokens = vec![String::new()];
    let mut after_small = false;
    for letter in name.chars() {
        if !letter.is_alphabetic() || (letter.is_uppercase() && after_small) {
            tokens.push(String::new());
        }
        after_small = letter.is_lowercase();
        if let Some(token) = tokens.last_mut().filter(|_| letter.is_alphabetic()) {
            letter.to_lowercase().for_each(|l| token.push(without_accent(l)));
        }
    }
    tokens.retain(|t| !t.is_empty());
    tokens
}

fn without_accent(letter: char) -> char {
    const ACCENTS: &[(char, &str)] =
        &[('a', "áàâäãå"), ('e', "éèêë"), ('i', "íìîï"), ('o', "óòôöõ"), ('u', "úùûü"), ('c', "ç"), ('n', "ñ")];
    ACCENTS.iter().find(|(_, accented)| accented.contains(letter)).map_or(letter, |(plain, _)| *plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strongest(name: &str) -> Option<Role> {
        read_name(name).into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|f| f.0)
    }

    #[test]
    fn names_of_real_parts_are_understood() {
        for (name, role) in [
            ("twig leaves", Role::Leaf),
            ("Leaves1", Role::Leaf),
            ("Pine_Leaves", Role::Leaf),
            ("EU43lef1", Role::Leaf),
            ("Eichenblatt", Role::Leaf),
            ("Blätter", Role::Leaf),
            ("FEUILLES", Role::Leaf),
            ("DeadBranch", Role::Wood),
            ("Birch_Bark", Role::Wood),
            ("AL01brk", Role::Wood),
            ("Écorce.001", Role::Wood),
            ("GlassAlpha", Role::Other),
            ("Flowerpot", Role::Other),
        ] {
            assert_eq!(strongest(name), Some(role), "{name}");
        }
    }

    #[test]
    fn names_that_say_nothing_say_nothing() {
        for name in ["White", "Black", "Green", "DarkGreen", "Bush", "tree", "Plane.003", "Cube.070", "Material", ""] {
            assert_eq!(strongest(name), None, "{name}");
        }
    }

    #[test]
    fn short_words_count_only_alone() {
        assert_eq!(strongest("Palast"), None);
        assert_eq!(strongest("Ast_3"), Some(Role::Wood));
    }

    #[test]
    fn no_word_speaks_for_two_roles() {
        let mut words: Vec<&str> = WORDS.iter().flat_map(|w| w.2.split_whitespace()).collect();
        let count = words.len();
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), count);
        assert!(words.iter().all(|w| w.chars().all(|c| c.is_ascii_lowercase())));
    }
}
