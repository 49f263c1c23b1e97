//! Stroke letters and digits for titles and legends.
use super::canvas::Lines;

/// Height of capital letters and digits, in units of the strokes.
const UNITS: f64 = 6.0;
/// Space between two letters, in units of the strokes.
const GAP: f64 = 2.0;

/// Returns the polylines of a letter, separated by blanks; each point is two digits, x to the right and y down from the
/// top line. The base line is y = 6. Capitals are drawn as small letters, unknown characters as a box.
#[rustfmt::skip]
fn strokes(letter: char) -> &'static str {
    match letter.to_ascii_lowercase() {
        ' ' => "",
        '0' => "103041453616050110", '1' => "112026 1636", '2' => "01103041420646",
        '3' => "011030414233 13334445361605", '4' => "36300444", '5' => "40000312324345361605",
        '6' => "413010010516364544331304", '7' => "004016", '8' => "13020110304142331304051636454433",
        '9' => "051636454130100102133342",
        '.' => "0606", '-' => "0333", '+' => "0343 2125", '/' => "0640", '_' => "0747", ':' => "0303 0606",
        '≥' => "014305 0747",
        'a' => "12324346 441405163645", 'b' => "0006 0312324345361605", 'c' => "4332120305163645",
        'd' => "4046 4332120305163645", 'e' => "04444332120305163645", 'f' => "30201116 0232",
        'g' => "4247381807 4332120305163645", 'h' => "0006 0312324346", 'i' => "0206 0000", 'j' => "121708 1010",
        'k' => "0006 3205 1436", 'l' => "000516", 'm' => "0206 03122326 23324346", 'n' => "0206 0312324346",
        'o' => "123243453616050312", 'p' => "0208 0312324345361605", 'q' => "4248 4332120305163645",
        'r' => "0206 03122232", 's' => "43321203143445361605", 't' => "10152636 0232", 'u' => "0205163645 4246",
        'v' => "022642", 'w' => "0216243642", 'x' => "0246 4206", 'y' => "0226 4218", 'z' => "02420646",
        _ => "0040460600",
    }
}

fn points(polyline: &str) -> impl Iterator<Item = [f64; 2]> {
    let digit = |b: u8| f64::from(b.saturating_sub(b'0'));
    polyline
        .as_bytes()
        .chunks_exact(2)
        .map(move |p| [digit(p[0]), digit(p[1])])
}

fn letter_width(letter: char) -> f64 {
    let widest = strokes(letter).split(' ').flat_map(points).map(|p| p[0]);
    widest.fold(if letter == ' ' { 1.0 } else { 0.0 }, f64::max)
}

/// Returns the width of a line of text whose digits are `height` pixels high.
pub(super) fn width(text: &str, height: f64) -> f64 {
    let units: f64 = text.chars().map(|letter| letter_width(letter) + GAP).sum();
    (units - GAP).max(0.0) * height / UNITS
}

/// Writes a line of text; `(x, y)` is the upper left corner, in pixels.
pub(super) fn write(lines: &mut Lines, text: &str, x: f64, y: f64, height: f64) {
    let unit = height / UNITS;
    let mut left = x;
    for letter in text.chars() {
        for polyline in strokes(letter).split(' ') {
            let place = |p: [f64; 2]| [left + p[0] * unit, y + p[1] * unit];
            let points: Vec<[f64; 2]> = points(polyline).map(place).collect();
            for pair in points.windows(2) {
                lines.segment(pair[0], pair[1], (0.14 * height).max(1.2));
            }
        }
        left += (letter_width(letter) + GAP) * unit;
    }
}
