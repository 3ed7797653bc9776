// SPDX-License-Identifier: GPL-3.0-or-later
//
// Upper half of a channel of half height 2 with a cylinder of radius 1 in its middle, -10 < x < 15: the benchmark of
// viscoelastic flow round a confined cylinder.  Quadrilaterals only, finer towards the cylinder, where stresses have
// thin layers, and towards the axis behind it.
//
//     +-----------+-------+-----------------+ walls
//     |           | \   / |                 |
//     +-----------+- (   ) -+---------------+ axis

// n: cells per quarter of the half circle.
DefineConstant[ n = {12, Min 4, Max 100, Step 4, Name "Cells per eighth of the circle"} ];

n_radial = Ceil(1.5 * n);
n_left = Ceil(1.5 * n);
n_right = Ceil(4 * n);
q_radial = 1.12^(12 / n);
q_left = 1.12^(12 / n);
q_right = 1.05^(12 / n);

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 0;
Mesh.RecombineAll = 0;

d = 1 / Sqrt(2);
Point(1) = {0, 0, 0};
Point(2) = {-1, 0, 0};
Point(3) = {-d, d, 0};
Point(4) = {d, d, 0};
Point(5) = {1, 0, 0};
Point(6) = {-2, 0, 0};
Point(7) = {-2, 2, 0};
Point(8) = {2, 2, 0};
Point(9) = {2, 0, 0};
Point(10) = {-10, 0, 0};
Point(11) = {-10, 2, 0};
Point(12) = {15, 0, 0};
Point(13) = {15, 2, 0};

// Cylinder: front, above, rear.
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
// Block round it, and from the cylinder to its corners.
Line(4) = {6, 7};
Line(5) = {7, 8};
Line(6) = {8, 9};
Line(7) = {2, 6};
Line(8) = {3, 7};
Line(9) = {4, 8};
Line(10) = {5, 9};
// Upstream and downstream.
Line(11) = {6, 10};
Line(12) = {10, 11};
Line(13) = {7, 11};
Line(14) = {9, 12};
Line(15) = {12, 13};
Line(16) = {8, 13};

Curve Loop(1) = {7, 4, -8, -1};
Curve Loop(2) = {8, 5, -9, -2};
Curve Loop(3) = {9, 6, -10, -3};
Curve Loop(4) = {11, 12, -13, -4};
Curve Loop(5) = {14, 15, -16, 6};
For s In {1:5}
    Plane Surface(s) = {s};
EndFor

Transfinite Curve {1, 4, 12} = n + 1;
Transfinite Curve {3, 6} = n + 1;
Transfinite Curve {15} = n + 1;
Transfinite Curve {2, 5} = 2 * n + 1;
Transfinite Curve {7:10} = n_radial + 1 Using Progression q_radial;
Transfinite Curve {11, 13} = n_left + 1 Using Progression q_left;
Transfinite Curve {14, 16} = n_right + 1 Using Progression q_right;
Transfinite Surface {1:5};
Recombine Surface {1:5};

Physical Curve("inlet") = {12};
Physical Curve("outlet") = {15};
Physical Curve("walls") = {5, 13, 16};
Physical Curve("axis") = {7, 10, 11, 14};
Physical Curve("cylinder") = {1, 2, 3};
Physical Surface("fluid") = {1:5};
