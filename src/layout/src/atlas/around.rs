//! Charts packed around others that stay where they are.
//!
//! The cells of those that stay are taken before the first chart is placed; nothing else is known of them. The pages are used as
//! they are, so that only the scale of the others is searched for: the largest at which each finds a place, in an order that is
//! searched for, too.
use super::attempt::{Extent, Packing, SLACK};
use super::largest::placed;
use super::layout::{Layout, padding, raster};
use super::outline::outlines;
use super::pack::{self, is_cramped, snapped};
use super::plan::Plan;
use super::sheet::Sheet;
use super::snap::Repair;
use super::stay::{AroundError, Stay};
use super::stays::{Staying, too_near};
use super::{Atlas, AtlasOptions, ChartMap, GRID_SIDE, OnRead, Rotation, doubled_area};

/// Cells by which the used part of a page is rounded down at most, and one more.
const FRAME: u32 = 4;
/// Layouts tried until no vertex moves farther than its chart's room.
const ROUNDS: usize = 6;

/// Packs charts around others that stay, with quarter turns at most. The atlas has the packed charts first.
pub fn pack_around(
    charts: &[ChartMap],
    stays: &[Stay],
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Atlas, AroundError> {
    let texture = options.texture;
    let staying = Staying::all(stays, texture)?;
    let longer = f64::from(texture.resolution.longer());
    let gap = f64::from(options.padding_texels) / longer;
    if let Some((islands, distance)) = too_near(&staying, gap) {
        return Err(AroundError::TooNear {
            islands,
            texels: distance * longer,
        });
    }
    let mut atlas = around(charts, &staying, options, on_read)?;
    for (stay, staying) in stays.iter().zip(staying) {
        let placed = staying.placed(texture);
        let doubled = |t: &[u32; 3]| doubled_area(t.map(|v| placed.grid[v as usize])) as f64;
        let covered: f64 = stay.map.triangles.iter().map(doubled).sum();
        atlas.utilization += covered / (2.0 * GRID_SIDE * GRID_SIDE * f64::from(texture.pages));
        atlas.placed.push(placed);
    }
    Ok(atlas)
}

fn around(
    charts: &[ChartMap],
    staying: &[Staying],
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Atlas, AroundError> {
    let texture = options.texture;
    // Other islands keep their angles, up to quarter turns, while one is arranged by hand.
    let options = &AtlasOptions {
        rotation: match options.rotation {
            Rotation::Any => Rotation::Quarter,
            rotation => rotation,
        },
        ..options.clone()
    };
    let plan = Plan::largest_first(&outlines(charts)?, options);
    let on_page = plan.order.len() / texture.pages.max(1) as usize;
    let cells = texture.raster(raster(on_page, options.most_cells));
    let padding = padding(options, plan.order.len().max(1), f64::from(cells));
    let mut slack = vec![SLACK; charts.len()];
    for round in 0..=ROUNDS {
        let mut packing = Packing {
            plan: &plan,
            slack: &slack,
            texture,
            cells,
            padding,
            border: (padding / 2.0).max(SLACK),
            on_read,
            is_alike: false,
            extent: Extent::Full,
            taken: None,
        };
        let taken = taken(&packing, staying);
        packing.taken = Some(&taken);
        let (scale, attempt) = placed(&packing, staying, options).ok_or(AroundError::NoRoom)?;
        let cell = texture.grid_side() / f64::from(cells);
        let longer = f64::from(texture.resolution.longer());
        let layout = Layout {
            scale: scale * cell,
            cell,
            border: packing.border,
            spare: 0.0,
            padding_texels: (padding * longer / f64::from(cells))
                .min(f64::from(options.padding_texels)),
            charts: attempt.spots,
        };
        let repair = if round < ROUNDS {
            Repair::Open
        } else {
            Repair::Nothing
        };
        let snapped = snapped(charts, &plan.outlines, &layout, repair);
        if repair == Repair::Nothing || !is_cramped(&snapped, &layout, &mut slack) {
            return Ok(pack::atlas(charts, &layout, &slack, snapped, options));
        }
    }
    Err(AroundError::NoRoom)
}

/// Pages on which the cells of charts that stay are taken.
fn taken(packing: &Packing, staying: &[Staying]) -> Sheet {
    let whole = packing.whole();
    // Charts that stay may reach into the borders, which are free of others.
    let frame = (packing.reach() + packing.border).ceil() as u32 + FRAME;
    let mut sheet = Sheet::new(packing.form(), whole, frame, whole);
    for chart in staying {
        let (body, corner) = chart.body(packing.texture, packing.cells, packing.border);
        sheet.cover(&body, chart.page, corner);
    }
    sheet
}
