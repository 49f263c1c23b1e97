//! What is pulled and arranged by the mouse.

use super::{asset, scenario, text, unwrapped_into_islands};
use crate::cli::{assert_status, unwrapd};
use crate::server::Server;
use crate::server::sessions::sheet;

/// Something is held at a first place of the view and dragged by the mouse from a second to a third, in shares of its size.
async fn pulled(file: String, what: &str, places: &str) {
    let server = Server::start();
    let arguments = [file, what.to_owned(), places.to_owned()];
    let said = scenario("pull", server.url("/"), &arguments).await;
    assert!(said["frames"].as_u64() > Some(10), "{said}");
}

#[tokio::test]
async fn a_mesh_of_the_plane_is_pulled() {
    let folder = tempfile::tempdir().expect("a folder");
    let off = folder.path().join("sheet.off");
    std::fs::write(&off, sheet(16).1).expect("a file");
    let places = "[[0.5, 0.85], [0.5, 0.2], [0.62, 0.4]]";
    pulled(text(&off), "Planar mesh", places).await;
}

#[tokio::test]
async fn a_picture_is_pulled() {
    let places = "[[0.4, 0.6], [0.6, 0.5], [0.7, 0.3]]";
    pulled(asset("pictures/spot.png"), "Picture", places).await;
}

#[tokio::test]
async fn a_surface_in_a_cage_is_pulled() {
    let places = "[[0.5, 0.62], [0.5, 0.42], [0.62, 0.3]]";
    pulled(asset("spot.ply"), "Surface in a cage", places).await;
}

#[tokio::test]
async fn islands_are_arranged_and_the_others_packed_around_them() {
    let server = Server::start();
    let folder = tempfile::tempdir().expect("a folder");
    let url = unwrapped_into_islands(&server).await;
    let files = ["before.glb", "after.glb"].map(|name| text(&folder.path().join(name)));
    scenario("arrange", url, &files).await;
    let [_, output] = files;
    let verified =
        tokio::task::spawn_blocking(move || unwrapd(&["verify", &output, "--bijective"]));
    assert_status(&verified.await.expect("no panic"), 0);
}

#[tokio::test]
async fn islands_make_room_while_one_is_dragged() {
    let server = Server::start();
    let folder = tempfile::tempdir().expect("a folder");
    let url = unwrapped_into_islands(&server).await;
    let output = text(&folder.path().join("baked.glb"));
    scenario("make_room", url, std::slice::from_ref(&output)).await;
    let verified =
        tokio::task::spawn_blocking(move || unwrapd(&["verify", &output, "--bijective"]));
    assert_status(&verified.await.expect("no panic"), 0);
}
