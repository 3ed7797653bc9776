// SPDX-License-Identifier: GPL-3.0-or-later
//
// Channel 2.2 x 0.41 (m) with a cylinder of radius 0.05 at (0.2, 0.2): the DFG benchmark
// "flow around a cylinder" in 2D (Schaefer and Turek, 1996).
//
// Quadrilaterals only.  Four transfinite blocks run from the cylinder to the square
// [0, 0.41]^2, finer towards the cylinder; a rectangular block holds the wake.
//
//     +---------+--------------------------+
//     | \     / |                          |
//     |    O    |                          |
//     | /     \ |                          |
//     +---------+--------------------------+

// n: cells per quarter of the cylinder and across the channel.
DefineConstant[ n = {24, Min 4, Max 200, Step 4, Name "Cells per quarter"} ];

H = 0.41;
L = 2.2;
cx = 0.2;
cy = 0.2;
r = 0.05;

n_radial = Ceil(1.25 * n);
n_wake = Ceil(3.75 * n);
// Ratios of neighbouring cells; the total grading is the same for every n.
q_radial = 1.07^(24 / n);
q_wake = 1.012^(24 / n);

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 0;
Mesh.RecombineAll = 0;

d = r / Sqrt(2);
Point(1) = {cx, cy, 0};
Point(2) = {cx - d, cy - d, 0};
Point(3) = {cx + d, cy - d, 0};
Point(4) = {cx + d, cy + d, 0};
Point(5) = {cx - d, cy + d, 0};
Point(6) = {0, 0, 0};
Point(7) = {H, 0, 0};
Point(8) = {H, H, 0};
Point(9) = {0, H, 0};
Point(10) = {L, 0, 0};
Point(11) = {L, H, 0};

// Cylinder: below, right, above, left.
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
// Square.
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 9};
Line(8) = {9, 6};
// From the cylinder to the corners of the square.
Line(9) = {2, 6};
Line(10) = {3, 7};
Line(11) = {4, 8};
Line(12) = {5, 9};
// Wake.
Line(13) = {7, 10};
Line(14) = {10, 11};
Line(15) = {8, 11};

Curve Loop(1) = {9, 5, -10, -1};
Curve Loop(2) = {10, 6, -11, -2};
Curve Loop(3) = {11, 7, -12, -3};
Curve Loop(4) = {12, 8, -9, -4};
Curve Loop(5) = {13, 14, -15, -6};
For s In {1:5}
    Plane Surface(s) = {s};
EndFor

Transfinite Curve {1:8, 14} = n + 1;
Transfinite Curve {9:12} = n_radial + 1 Using Progression q_radial;
Transfinite Curve {13, 15} = n_wake + 1 Using Progression q_wake;
Transfinite Surface {1:5};
Recombine Surface {1:5};

Physical Curve("inlet") = {8};
Physical Curve("outlet") = {14};
Physical Curve("walls") = {5, 7, 13, 15};
Physical Curve("cylinder") = {1:4};
Physical Surface("fluid") = {1:5};
