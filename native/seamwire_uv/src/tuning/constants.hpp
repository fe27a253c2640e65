// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

/// The constants that decide which seams and parts are found: what each is, and why it has its value if that is known.
///
/// Constants of a single algorithm, such as tolerances and shares of progress, are where they are used.
/// docs/notebook/planner-tuning.md says what was tried.
namespace seamwire::detail::tuning {

// Symmetry: which mirror images correspond.

/// Distance from the surface, in diagonals, within which a mirror image corresponds to it. It has the value of the
/// prototype.
inline constexpr double kNearImage = 0.012;
/// Distance in median edges within which the nearest vertex is looked for at least. On coarse meshes that vertex may be
/// far along the surface, though the surface is near.
inline constexpr double kCoarseImage = 0.75;
/// Share of the area that has to correspond on a symmetric surface.
inline constexpr double kLeastSymmetric = 0.9;
/// Share of the edges whose images are edges from which on a mesh or a piece counts as mirrored edge by edge. It has
/// the value of the prototype.
inline constexpr double kExactImages = 0.95;

// Visibility of places: how much of the front and of the sky sees a vertex.

/// Directions of view from the front. The benchmarks measure visibility with as many.
inline constexpr int kViews = 20;
/// Rays to the sky above a vertex. The prototype had 48, for twice the time.
inline constexpr int kSkyRays = 24;

// Price of a place, by its visibility. Without it seams would be short, but as visible as any other line.

/// Share of the front in the visibility, the rest is open sky. With open sky alone, seams ran over the front of both
/// heads on which the planner was tuned.
inline constexpr double kFrontShare = 0.7;
/// Price of a place that nobody sees, in that of an average place. With 0.12, seams were longer and crossed the
/// middle of wings.
inline constexpr double kHidden = 0.25;
/// Visibility from which a place is exposed: above the mean, where the eyes, nose and lips of a head are.
inline constexpr double kExposed = 1.45;
/// Times that an exposed place costs as much. Without it, slits ran through eyes and noses.
inline constexpr double kExposedPrice = 9.0;

// Price of an edge, by the shape of the surface.

/// Curvature of the rim of a thin part, on a surface of area 1. There, the saving is greatest.
inline constexpr double kRidgeCurvature = 30.0;
/// Share of the price that such a rim saves. Artists cut thin parts along their rims.
inline constexpr double kRidgeSaving = 0.75;
/// Log odds up to which an edge costs as in a flat place.
inline constexpr double kFlatOdds = -1.9;

// Price of a slit, beside its edges.

/// Price of each slit. Without it, tiny slits beside the cut win.
inline constexpr double kSlitPrice = 0.04;
/// Price of a turn by 90 degrees, in median edges at the mean price. Artists' seams go straight on at nearly all
/// regular vertices.
inline constexpr double kTurnPrice = 1.5;
/// Share of this price that a turn adds to the price of a plan. Without it, the slits of a ball had eight jogs. With 1,
/// a trunk was cut elsewhere than by its artist.
inline constexpr double kTurnInPlan = 0.5;

// Kinds of shapes: machine parts, figures and garments.

/// Degrees above which the bend of an edge counts as sharp. Rims of regions with sharp edges are such edges too.
inline constexpr double kSharpDegrees = 30.0;
/// Share of all bending in sharp edges up to which an artist's mesh may be a figure. Above it, a surface is a machine
/// part if most of its edges hardly bend. Heads have up to 0.47.
inline constexpr double kMostSharp = 0.5;
/// Degrees below which an edge hardly bends. Most edges of an animal of few triangles bend more.
inline constexpr double kFlatDegrees = 15.0;

// Log odds of an edge of being a border between parts. They are hand-made, after the features that a learned
// model used most.

/// Distance on both sides, as a share of the diagonal, at which a wide bend is measured. It spans the steps of a
/// chamfer.
inline constexpr double kWideReach = 0.015;
/// Share of the mean bend of the edge's line in the bend. Borders go on along lines of edges, over edges that bend
/// less.
inline constexpr double kLineShare = 0.2;
/// Share of the bend by which a wide bend exceeds the edge's own. Without it, a chamfer is no sharp edge.
inline constexpr double kWideShare = 0.8;
/// A wide bend exceeds the edge's own by at most so many times that, or curved places would count as chamfers.
inline constexpr double kMostSteps = 1.5;
/// Times by which bends at opposite edges of a polygon differ at most where the surface is round. A round edge is no
/// chamfer. Without round edges, a tube with few sides falls into several parts.
inline constexpr double kAlikeBends = 2.0;
/// Bend at which a border is as likely as not, apart from what follows. On hard surfaces, edges above 45 degrees agreed
/// best with artists' seams, but seams are only 6 % of the length of all edges.
inline constexpr double kEvenDegrees = 62.6;
/// Degrees that add 1 to the log odds.
inline constexpr double kDegreesOfOdds = 18.0;
/// Taken off for each unit of openness above the mean, because artists hide borders.
inline constexpr double kOpenness = 4.0;
/// Taken off beside a sharper edge of the same polygon. Otherwise both sides of a narrow strip are borders.
inline constexpr double kBesideSharper = 1.5;
/// Degrees by which the other edge has to be sharper.
inline constexpr double kSharperBy = 5.0;
/// Added in creases.
inline constexpr double kConcave = 1.0;
/// Degrees from which a concave edge is a crease.
inline constexpr double kConcaveDegrees = 20.0;
/// Added for borders on the mirror plane, unless the surface is round there. It was the strongest feature of a learned
/// model.
inline constexpr double kOnPlane = 2.0;
/// The same for slits: half, because a path on the plane is cut once, and a path beside it twice.
inline constexpr double kSlitOnPlane = 0.5 * kOnPlane;
/// Added where an artist expects a border. It is enough to make a border of a flat edge.
inline constexpr double kMarked = 6.0;
/// Share of the inner edges of a piece above which marks are everywhere, and say nothing.
inline constexpr double kMarkedEverywhere = 0.8;
/// Log odds are clamped to this, so that no edge alone decides. A clamp at 2 gave the same agreement with artists.
/// Edges between panels have at least this. An edge with this or more is never a fold of a net: at the far end of the
/// scale, the sides of a cube are islands.
inline constexpr double kMostOdds = 4.0;

// Polygons: lines of edges. quad_skew() says which triangles count as quads.

/// Degrees that a line turns at most at a vertex of four edges, where the opposite edge continues it.
inline constexpr double kOverVertex = 80.0;
/// Degrees that a line turns at most at other vertices, where the straightest edge continues it.
inline constexpr double kMostTurn = 50.0;

// Parts: which regions stay apart.

/// Log odds for each unit of the amount's log odds below the middle of the scale. The scale ends in one part at 0.
inline constexpr double kBiasToOne = 1.2;
/// Log odds that are added from the middle of the scale to its other end, where all sharp edges are borders.
inline constexpr double kBiasToSharp = 2.2;
/// Price of a part, in diagonals of its piece. A lower price gives more parts.
inline constexpr double kPartPrice = 0.2;
/// The same for a part that a single other one surrounds. Caps and buttons have short rims, and artists part them.
inline constexpr double kEnclosedPrice = 0.05;
/// Share of the area of its piece below which a part or a limb joins a neighbor. Without it, characters get crumbs at
/// ears and fingers. Limbs with necks have at least this share of the whole surface.
inline constexpr double kLeastPart = 0.003;
/// Width in diagonals of its piece below which a part may be a step of a chamfer.
inline constexpr double kLeastPartWidth = 0.008;
/// Vertices at which visibility is measured at most, because rays take most of the time on large meshes.
inline constexpr std::size_t kMostLooks = 8000;
/// Mean log odds of a rim that encloses a small separate part, such as a button or a plug.
inline constexpr double kSharpRim = 2.0;
/// Degrees by which the surface bends at the sides of a chamfer's step, at least.
inline constexpr double kLeastStep = 25.0;
/// Degrees at the sides of a chamfer's step, at most.
inline constexpr double kMostStep = 70.0;
/// Share of an area by which regions differ at most that are joined in mirrored pairs.
inline constexpr double kAlikeAreas = 0.01;
/// Share of the area that each half of a piece has, if there is such a cut. Without it, a cut may take off a sliver.
inline constexpr double kLeastHalf = 0.2;
/// Shares of the area of a piece that are given to both halves before the cheapest cut between them is found.
inline constexpr std::array<double, 3> kSeedShares{0.2, 0.3, 0.4};

// Nets: pieces of flat parts that open as cardboard does.

/// Distance in diagonals of a piece that unfolded triangles may leave between them.
inline constexpr double kNetGap = 1e-3;
/// Parts of a piece that opens as a net, at most.
inline constexpr std::size_t kMostPanels = 24;

// Limbs whose necks are cut if more islands are wanted.

/// Share of the way from a tip to the farthest vertex beyond which nothing is part of the limb.
inline constexpr double kLimbReach = 0.6;
/// Times that rings on both sides of a neck are longer than the neck's own, at least.
inline constexpr double kNeckNarrow = 1.2;
/// Share of the surface's area that a limb has at most. A larger one is the rest of the surface.
inline constexpr double kMostLimb = 0.5;

// Regions whose rims are cut if slits do not reach the bound. They help cylinders with many corners.

/// Corners of a rim, at least: too many for a slit to each of them.
inline constexpr std::size_t kManyCorners = 16;
/// Share of the area of its piece that the region has at least.
inline constexpr double kLeastRimmed = 2e-3;
/// Degrees below which the bend of an edge is inside a flat region.
inline constexpr double kFlatBelow = 1.5;

// The first tree of slits. Lengths are in roots of the area of a piece.

/// Height by which the tip of a limb stands out in mean distance. Lower bumps get no slit of the tree.
inline constexpr double kTipProminence = 0.08;
/// Times that closed lines of edges cost more than the cheapest cut through all handles, at most. Along a line, a seam
/// goes straight on at every vertex.
inline constexpr double kLineDetour = 1.5;
/// Area within the length of a loop from it, in the square of that length: about 4 around a hole in a plane, 1 at
/// the end of a tube. With less than this, the loop is the end of a tube.
inline constexpr double kLeastAround = 2.0;
/// Curvature in radians of a filled hole from which on its loop is the end of a tube. A cone that has less can be laid
/// out as a ring with an energy below 4.07.
inline constexpr double kLeastTubeTurn = 1.0471975511965976;
/// Distance from a hole within which its surroundings decide, as a share of its outline: 1.6 of its radius.
inline constexpr double kCollar = 0.25;

/// Distance from the mirror image of a slit at which an edge costs twice its price, on a surface of area 1. It matters
/// if a mesh is not mirrored edge by edge.
inline constexpr double kMirrorSpread = 0.02;

// Candidates: places to which a further slit may lead. Lengths are for a surface of area 1.

/// Radius over which distortion is summed up for peaks close to their cause.
inline constexpr double kClosePeak = 0.05;
/// The same for peaks of whole regions.
inline constexpr double kWidePeak = 0.15;
/// Candidates of each kind: close peaks, wide peaks, places far from the cut, and joins of holes. Without far places, a
/// surface with a tiny boundary was stuck at an energy of 5.9.
inline constexpr std::size_t kOfEachKind = 3;
/// Distance below which two candidates are one, and below which there is no peak near the cut. A slit to it would be a
/// crumb. A tip that is nearer to the mirror plane is moved onto it, or a back gets two parallel slits; this is in
/// roots of the area of its piece.
inline constexpr double kApart = 0.07;
/// Energy of a triangle above 4 that counts at most, so that one collapsed triangle does not hide all other peaks.
inline constexpr double kMostExcess = 50.0;
/// Places all over the surface that are tried if no likely one helps.
inline constexpr std::size_t kThoroughPlaces = 48;

// The search: it adds slits, shortens them, and exchanges them.

/// Newton steps of a trial, which tells about what a slit gains. A full solve of the search may take 60.
inline constexpr std::size_t kTrialSteps = 6;
/// Newton steps at most for the map of a finished cut, and as many more if its outline crosses itself. A body with
/// fingers takes more than 100, and a map that is not solved to its end seems to miss the bound.
inline constexpr std::size_t kFinishedSteps = 300;
/// Energy below the bound to which slits are added, so that there is something to give away. Without it, a seam was
/// 2.3 long instead of 1.9.
inline constexpr double kGrowBelow = 0.03;
/// Energy that a slit gains at least.
inline constexpr double kLeastGain = 2e-3;
/// The same while the bound is not reached and no other slit helps.
inline constexpr double kFinestGain = 1e-4;
/// Prices of a slit that are added when slits are compared, so that tiny slits do not win.
inline constexpr double kChoicePrice = 2.5;
/// Times that a gain counts if the map overlaps itself, because it costs 0.02 to 0.03 of energy to undo that.
inline constexpr double kOverlappingGain = 0.3;
/// Slits that are tried for an exchange in each round.
inline constexpr std::size_t kExchanges = 8;
/// Shares of a slit's length that may stay, in the order in which they are tried.
inline constexpr std::array<double, 3> kShorterShares{0.0, 0.6, 0.85};

// The planner: budgets, and simplified meshes.

/// Newton steps on the whole surface that a search takes at most.
inline constexpr double kBudget = 4000.0;
/// Newton steps for each triangle of a surface that is planned on simplified meshes. A step there takes as long for any
/// surface, so larger ones may have more.
inline constexpr double kBudgetOfTriangle = 0.04;
/// Bound on the energy below which exposed places may be cut. At 4.1, one head needed a slit from the throat to the
/// lip.
inline constexpr double kLowStretch = 4.15;
/// Triangles above which a surface is planned on simplified meshes. A Newton step on 28,000 triangles takes 40 ms. With
/// 11000, a surface of 10,540 triangles took 3.5 times as long.
inline constexpr std::size_t kMostTriangles = 9000;
/// Triangles that all simplified meshes have together, about.
inline constexpr std::size_t kSimplified = 11000;
/// Triangles of each group, at least, and of the coarser mesh on which seams are also searched. A group that is
/// smaller itself stays as it is. If the searched mesh of one of several groups has fewer, the group is planned on one
/// thread, at the same time as other such groups. Their plans are shown only once all of them are done.
inline constexpr std::size_t kLeastSimplified = 600;
/// Times that a chain of the original mesh is longer than the slit that it follows, at most. A longer chain leads
/// around something.
inline constexpr double kDetour = 1.6;
/// Times that a slit is longer than the straight line between its ends from which on it is followed in parts. A chain
/// might cut it short otherwise, as it would a loop around a handle.
inline constexpr double kBent = 2.0;
/// How often a search is repeated because the original mesh distorts more than the simplified one.
inline constexpr int kRounds = 2;
/// Budget of a repetition, as a share of the one before.
inline constexpr double kLaterBudget = 0.5;
/// Energy below the bound from which on a map may have too many seams, so that the search is repeated.
inline constexpr double kNearBound = 0.02;
/// Energy below the bound at which a repeated search aims, because the meshes do not differ by the same amount
/// again.
inline constexpr double kMargin = 3e-3;
/// How often pieces without a map are cut into halves.
inline constexpr int kHalvings = 4;

// Wires of a plan. Lengths are in roots of the area of a piece.

/// Distance from a slit that wires across the surface keep, first and if the map is bad with these.
inline constexpr std::array<double, 2> kNearSlit{0.04, 0.015};
/// Times that such wires may raise an energy that is above the bound already.
inline constexpr double kWorse = 1.01;
/// Distance of a slit from a straight line above which it gets another seed, along edges.
inline constexpr double kStraight = 0.1;

// Limbs. Lengths are in roots of the area of a piece, costs and areas in its area.

/// Size of details that do not count.
inline constexpr double kLimbDetail = 0.02;
/// A radian of concavity resists as much as this distance.
inline constexpr double kLimbConcavity = 3.0;
/// Concavity over a detail, in radians, that divides the weight of a border by e, and the least weight.
inline constexpr double kLimbSteepness = 0.5;
inline constexpr double kLeastLimbWeight = 0.02;
/// Area of a region in squares of its perimeter below which it is joined more cheaply: a disc has 0.08.
inline constexpr double kLimbCompactness = 0.1;
/// Area below which a region is joined more cheaply.
inline constexpr double kLimbArea = 0.006;
/// Share of the area in flat triangles up to which a shape is a figure. Scans of figures have up to 0.04, machine parts
/// 0.12 and more.
inline constexpr double kMostFlat = 0.08;
/// Triangles from which a mesh is a sculpt: artists' game models have fewer.
inline constexpr std::size_t kLeastSculpt = 20000;
/// Share of the area that the rims of a figure leave in one part. Heads have at least 0.95; a prop whose bending is as
/// soft has 0.87.
inline constexpr double kLeastBody = 0.95;
/// Number of polygons up to which a mesh is coarse, and share of triangles up to which it is made of quads.
inline constexpr std::size_t kMostCoarse = 1000;
inline constexpr double kMostTriangular = 0.2;
/// Share of the border of a limb that may be in exposed places. Half of a ring around an arm is.
inline constexpr double kMostExposed = 0.6;
/// Curvature below which a triangle is flat.
inline constexpr double kFlatLimb = 0.3;
/// Distance from a border up to which it may move.
inline constexpr double kLimbBand = 0.03;
/// Joins up to this cost are made at the amount 0.5. Near 0, the limit is kLimbRange times as high.
inline constexpr double kLimbCost = 0.15;
inline constexpr double kLimbRange = 7.477;
/// The same range where the shape has chosen limbs: seams need fewer of them than people see.
inline constexpr double kFigureRange = 100.0;

// Panels: front and back of garments. Lengths are in diagonals of a piece, areas in its area.

/// Share of sharp edges, by length, up to which a piece may be a garment.
inline constexpr double kGarmentSharp = 0.15;
/// Open boundaries of a garment, at least.
inline constexpr std::int32_t kGarmentBoundaries = 3;
/// Price of a whole piece on the wrong side. Prices from 100 to 400 gave the same agreement with artists.
inline constexpr double kPanelFacing = 200.0;
/// Length of a line on the border that halves the price of its other edges. Without it, the border zigzags.
inline constexpr double kPanelLine = 0.1;
/// How often the border is found, with the prices that the last one leaves.
inline constexpr int kPanelRounds = 4;
/// Share of the area of a garment below which a part of one side joins the other side. It is also in the place of
/// kLeastPart, because folds beside the border would become scraps.
inline constexpr double kLeastOfPanels = 0.01;

// Scans. Each limit lies in the middle of a gap between artists' meshes, and scans, sculpts and remeshed surfaces, see
// docs/method/defaults.md.

/// Triangles below which the edges of a mesh are an artist's, who had to spare triangles.
inline constexpr std::size_t kLeastScan = 2000;
/// Triangles that are judged of a larger mesh, and the bands in which they lie.
inline constexpr std::size_t kMostJudged = 25000;
inline constexpr int kBands = 8;
/// How well the edges of artists follow the bends of the surface.
inline constexpr double kFollows = 0.28;
/// Spread of the lengths of edges below which a remesher made them, unless the mesh is regular, and the share of
/// regular vertices of such a mesh.
inline constexpr double kUniform = 0.33;
inline constexpr double kRegular = 0.96;
/// Spread from which on edges are an artist's, even if they do not follow the bends: those of scans reach 0.5.
inline constexpr double kUneven = 0.6;
/// Share of the area in flat triangles from which on edges are an artist's, even if they do not follow the bends.
inline constexpr double kFlatSides = 0.2;
/// Angle between triangles, in radians, up to which they lie in a plane (0.5 degrees).
inline constexpr double kInPlane = 0.0087;

}  // namespace seamwire::detail::tuning
