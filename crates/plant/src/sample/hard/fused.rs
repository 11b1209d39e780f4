//! Wood in one piece: the surface of all limbs together, as a scan or a sculpture has it (surface nets, Gibson 1998).

use super::limbs::Limb;
use crate::sample::build::Piece;
use glam::{DVec3, IVec3, Vec2};

/// Grid points up to so many cells off a limb are known: those of every cell that the surface crosses.
const SHELL: f64 = 2.0;
/// Grid coordinates are stored above this, so that none is negative.
const OFFSET: i32 = 1 << 20;
const BITS: u32 = 21;

/// One surface around limbs.
#[derive(Default)]
pub struct Surface {
    /// Vertices of each limb without triangles, and their rings.
    pub pieces: Vec<(Piece, Vec<u32>)>,
    /// Triangles: limb and vertex of it.
    pub faces: Vec<[(usize, u32); 3]>,
}

/// The surface around some limbs.
pub fn surface(limbs: &[Limb], cell: f64) -> Surface {
    let grid = Grid::new(limbs, cell);
    let (places, faces) = grid.surface();
    if limbs.is_empty() {
        return Surface::default();
    }
    let label = |place: &DVec3| {
        let off = |limb: &Limb| {
            let spot = limb.axis.nearest(*place);
            spot.distance - spot.radius
        };
        (0..limbs.len()).min_by(|&a, &b| off(&limbs[a]).total_cmp(&off(&limbs[b]))).unwrap_or(0)
    };
    let labels: Vec<usize> = places.iter().map(label).collect();
    let mut pieces: Vec<(Piece, Vec<u32>)> = limbs.iter().map(|_| Default::default()).collect();
    let mut names = Vec::with_capacity(places.len());
    for (place, &label) in places.iter().zip(&labels) {
        let (piece, rings) = &mut pieces[label];
        names.push((label, piece.positions.len() as u32));
        let axis = &limbs[label].axis;
        let arc = axis.nearest(*place).arc;
        piece.positions.push(place.as_vec3());
        piece.uvs.push(Vec2::ZERO);
        rings.push((axis.arcs.partition_point(|&a| a <= arc) as u32).saturating_sub(1));
    }
    Surface { pieces, faces: faces.iter().map(|face| face.map(|v| names[v as usize])).collect() }
}

/// Signed distances around limbs at grid points, sorted by key.
struct Grid {
    cell: f64,
    points: Vec<(u64, f64)>,
}

fn key(point: IVec3) -> u64 {
    let part = |x: i32| (x + OFFSET) as u64;
    part(point.x) << (2 * BITS) | part(point.y) << BITS | part(point.z)
}

fn unkey(key: u64) -> IVec3 {
    let part = |shift: u32| (key >> shift & ((1 << BITS) - 1)) as i32 - OFFSET;
    IVec3::new(part(2 * BITS), part(BITS), part(0))
}

impl Grid {
    fn new(limbs: &[Limb], cell: f64) -> Grid {
        let mut points = Vec::new();
        for axis in limbs.iter().map(|limb| &limb.axis) {
            for low in 0..axis.points.len() - 1 {
                let (a, b) = (axis.points[low], axis.points[low + 1]);
                let (from, to) = (axis.radii[low], axis.radii[low + 1]);
                let reach = from.max(to) + SHELL * cell;
                let corner = |p: DVec3| (p / cell).floor().as_ivec3();
                let (first, last) = (corner(a.min(b) - reach), corner(a.max(b) + reach) + IVec3::ONE);
                for x in first.x..=last.x {
                    for y in first.y..=last.y {
                        for z in first.z..=last.z {
                            let place = DVec3::new(x.into(), y.into(), z.into()) * cell;
                            let share = ((place - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
                            let off = place.distance(a.lerp(b, share)) - (from + (to - from) * share);
                            if off < SHELL * cell {
                                points.push((key(IVec3::new(x, y, z)), off));
                            }
                        }
                    }
                }
            }
        }
        points.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        points.dedup_by_key(|point| point.0);
        Grid { cell, points }
    }

    /// Signed distance; what is not known lies outside.
    fn at(&self, point: IVec3) -> f64 {
        let wanted = key(point);
        let found = self.points.binary_search_by_key(&wanted, |p| p.0);
        found.map_or(SHELL * self.cell, |index| self.points[index].1)
    }

    /// A vertex per cell that the surface crosses, and two triangles per edge of the grid that it crosses.
    fn surface(&self) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let corners = || (0..8).map(|k| IVec3::new(k & 1, k >> 1 & 1, k >> 2 & 1));
        let inside: Vec<IVec3> = self.points.iter().filter(|p| p.1 < 0.0).map(|p| unkey(p.0)).collect();
        let mut cells: Vec<u64> = inside.iter().flat_map(|p| corners().map(|c| key(*p - c))).collect();
        cells.sort_unstable();
        cells.dedup();
        let places: Vec<Option<DVec3>> = cells.iter().map(|&cell| self.vertex(unkey(cell))).collect();
        let mut number = 0;
        let numbers: Vec<u32> = places
            .iter()
            .map(|place| {
                number += u32::from(place.is_some());
                number.wrapping_sub(1)
            })
            .collect();
        let vertex = |cell: IVec3| cells.binary_search(&key(cell)).map_or(0, |index| numbers[index]);
        let mut faces = Vec::new();
        for point in &inside {
            for (axis, side) in (0..3).flat_map(|axis| [(axis, 1), (axis, -1)]) {
                let step = IVec3::AXES[axis] * side;
                if self.at(*point + step) < 0.0 {
                    continue;
                }
                // The four cells around the edge, seen from outside in counter-clockwise order.
                let (u, v) = (IVec3::AXES[(axis + 1) % 3], IVec3::AXES[(axis + 2) % 3]);
                let low = if side > 0 { *point } else { *point + step };
                let [a, b, c, d] = [low - u - v, low - v, low, low - u].map(vertex);
                let quad = if side > 0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
                faces.extend(quad);
            }
        }
        (places.into_iter().flatten().collect(), faces)
    }

    /// Mean of the places where the surface crosses a cell's edges.
    fn vertex(&self, cell: IVec3) -> Option<DVec3> {
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        for axis in 0..3 {
            let (u, v) = (IVec3::AXES[(axis + 1) % 3], IVec3::AXES[(axis + 2) % 3]);
            for start in [IVec3::ZERO, u, v, u + v].map(|corner| cell + corner) {
                let end = start + IVec3::AXES[axis];
                let (from, to) = (self.at(start), self.at(end));
                if (from < 0.0) != (to < 0.0) {
                    sum += start.as_dvec3().lerp(end.as_dvec3(), from / (from - to));
                    count += 1.0;
                }
            }
        }
        (count > 0.0).then(|| sum / count * self.cell)
    }
}
