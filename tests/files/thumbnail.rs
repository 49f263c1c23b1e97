//! Small copies of pictures, probed pixel by pixel.

use unwrapd_files::picture::{Image, thumbnail_png};

#[test]
fn thumbnails_have_the_means_of_what_they_show() {
    let mut wide = Image::transparent(576, 288);
    for (k, pixel) in wide.pixels.iter_mut().enumerate() {
        *pixel = if k % 576 < 288 {
            [200, 0, 0, 255]
        } else {
            [0, 0, 100 * (k % 2) as u8, 255]
        };
    }
    let small = Image::decode(&thumbnail_png(&wide.png()).unwrap()).unwrap();
    assert_eq!([small.width, small.height], [144, 72]);
    assert_eq!(small.pixels[144 * 50 + 20], [200, 0, 0, 255]);
    assert_eq!(small.pixels[144 * 50 + 100], [0, 0, 50, 255]);
    let own = Image::transparent(30, 40);
    assert_eq!(Image::decode(&thumbnail_png(&own.png()).unwrap()), Ok(own));
    assert!(thumbnail_png(b"no picture").is_err());
}
