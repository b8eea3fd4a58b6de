// Binding numbers, one per buffer and the same in every kernel, all in set 0. A kernel declares only the
// buffers it uses, at most seven of them storage buffers.
#ifndef GEODISK_SHARED_BINDINGS_H
#define GEODISK_SHARED_BINDINGS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

GEODISK_CONST uint kBindFaces = 0u;      // three rows of HalfEdgeRec per face; then one FaceLengthsRec per
                                         // face. For distances through space: a row per corner with its
                                         // coordinates in multiples of 2^-32 of the bounding box, then one
                                         // with its normal; after the first coordinates the area, after the
                                         // second the key
GEODISK_CONST uint kBindFans = 1u;       // a FanRec per vertex; then the fans' corners, pairs of half-edge
                                         // and angles; then the angles by half-edge; if radii vary, a
                                         // RadiiRec per face; from job.first_key_row on a key per face, if
                                         // the caller gives keys, always for several surfaces; then for
                                         // several surfaces the surface of each face, and a PartRec per
                                         // surface; from job.first_mask_row on a bit per face, 1 where it
                                         // takes samples; from job.first_class_row on the table of
                                         // classes
GEODISK_CONST uint kBindAxes = kBindFans; // for grids in space: two rows of AxisRec per axis
GEODISK_CONST uint kBindCells = 2u;      // place where the candidates of each cell start, and one past the
                                         // last; kBindStarts serves for a mesh with one cell per face
GEODISK_CONST uint kBindWeights = 3u;    // two words per candidate, by place: the weights of its face's second
                                         // and third corner, in units of 2^-24
GEODISK_CONST uint kBindPoints = kBindWeights; // coordinates of the candidates, by place, axis after axis;
                                               // for lengths of curves, then those of the normals; then the
                                               // number each was drawn by
GEODISK_CONST uint kBindOrders = 4u;     // a word per candidate, by place: its stage in the chunk and its
                                         // priority, or the slot of an active one; then two bits of state
                                         // per candidate
GEODISK_CONST uint kBindStarts = 5u;     // number of candidates drawn before each face or box cell, stage
                                         // by stage; then the total
GEODISK_CONST uint kBindPool = 6u;       // a slice per lane: LaneRec, windows, events, vertex table;
                                         // then a list of conflicts per slot
GEODISK_CONST uint kBindControl = 7u;    // ControlRec, then SlotRec per slot of an active candidate
GEODISK_CONST uint kBindList = 8u;       // candidates that come next: a count per range of orders, then
                                         // kListRange places
GEODISK_CONST uint kBindSums = 9u;       // block sums of the scans
GEODISK_CONST uint kBindSamples = 10u;   // SampleRec per accepted candidate, in dart order
GEODISK_CONST uint kBindAccepted = 11u;  // SampleRec per accepted candidate, in order of acceptance
GEODISK_CONST uint kBindBuckets = 12u;   // while samples are sorted: where each range of orders starts;
                                         // then the samples by range
GEODISK_CONST uint kBindConstants = 13u; // JobRec, a uniform buffer
// The same buffers as texel buffers, see lib/buffers.glsl.
GEODISK_CONST uint kBindPoolTexels = 14u;
GEODISK_CONST uint kBindOrdersTexels = 15u;
GEODISK_CONST uint kBindCellsTexels = 16u;
// Buffers of the caller.
GEODISK_CONST uint kBindVertices = 17u;  // floats
GEODISK_CONST uint kBindIndices = 18u;   // three of 16 or 32 bits per face
GEODISK_CONST uint kBindPlaced = 19u;    // PlacedRec per sample
GEODISK_CONST uint kBindArguments = 20u; // arguments of an indirect draw: four words
// Buffers of the lists of neighbours, see lib/neighbour.glsl.
GEODISK_CONST uint kBindNames = 21u;     // numbers of the targets, if they have others: where those of each
                                         // begin, and the end; then the numbers
GEODISK_CONST uint kBindLimits = 22u;    // a float per source: how far neighbours may be
GEODISK_CONST uint kBindRows = kBindCells; // where the entries of each source of a part begin
GEODISK_CONST uint kBindEntries = 23u;   // NeighbourRec per entry
GEODISK_CONST uint kBindSorted = 24u;    // the same, after a pass that merges
GEODISK_CONST uint kBindPlaces = 25u;    // while entries are chosen: 1 for those that stay; then their places
// Buffers of the caller, with all lists.
GEODISK_CONST uint kBindOffsets = 26u;   // where the neighbours of each source begin, and the end; then the
                                         // number of sources whose neighbours are complete
GEODISK_CONST uint kBindTargets = 27u;   // number of each neighbour
GEODISK_CONST uint kBindDistances = 28u; // its distance, a float

GEODISK_END_SHARED

#endif
