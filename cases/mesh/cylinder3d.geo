// SPDX-License-Identifier: GPL-3.0-or-later
//
// Channel 2.5 x 0.41 x 0.41 (m) with a cylinder of radius 0.05 along z at (0.5, 0.2): the DFG
// benchmark "flow around a cylinder" in 3D (Schaefer and Turek, 1996).
//
// Hexahedra only: a plane mesh of transfinite blocks, extruded along z in layers.
//
//     +----+---------+----------------------+
//     |    | \     / |                      |
//     |    |    O    |                      |
//     |    | /     \ |                      |
//     +----+---------+----------------------+

// n: cells per quarter of the cylinder and across the channel.
DefineConstant[ n = {6, Min 2, Max 60, Step 1, Name "Cells per quarter"} ];

H = 0.41;
L = 2.5;
cx = 0.5;
cy = 0.2;
r = 0.05;
x0 = cx - 0.2; // the square around the cylinder is [x0, x1] x [0, H]
x1 = x0 + H;

n_radial = n;
n_front = Ceil(n * 2 / 3);
n_wake = Ceil(n * 7 / 3);
n_layer = Ceil(n * 4 / 3);
// Ratios of neighbouring cells; the total grading is the same for every n.
q_radial = 1.3^(6 / n);
q_wake = 1.06^(6 / n);

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 0;
Mesh.RecombineAll = 0;

d = r / Sqrt(2);
Point(1) = {cx, cy, 0};
Point(2) = {cx - d, cy - d, 0};
Point(3) = {cx + d, cy - d, 0};
Point(4) = {cx + d, cy + d, 0};
Point(5) = {cx - d, cy + d, 0};
Point(6) = {x0, 0, 0};
Point(7) = {x1, 0, 0};
Point(8) = {x1, H, 0};
Point(9) = {x0, H, 0};
Point(10) = {L, 0, 0};
Point(11) = {L, H, 0};
Point(12) = {0, 0, 0};
Point(13) = {0, H, 0};

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
// In front of the square.
Line(16) = {12, 6};
Line(17) = {13, 9};
Line(18) = {13, 12};

Curve Loop(1) = {9, 5, -10, -1};
Curve Loop(2) = {10, 6, -11, -2};
Curve Loop(3) = {11, 7, -12, -3};
Curve Loop(4) = {12, 8, -9, -4};
Curve Loop(5) = {13, 14, -15, -6};
Curve Loop(6) = {16, -8, -17, 18};
For s In {1:6}
    Plane Surface(s) = {s};
EndFor

Transfinite Curve {1:8, 14, 18} = n + 1;
Transfinite Curve {9:12} = n_radial + 1 Using Progression q_radial;
Transfinite Curve {13, 15} = n_wake + 1 Using Progression q_wake;
Transfinite Curve {16, 17} = n_front + 1;
Transfinite Surface {1:6};
Recombine Surface {1:6};

// Extruding surface s gives: its copy, the volume, then one face per curve of its loop.
fluid[] = {};
cylinder[] = {};
walls[] = {};
For s In {1:6}
    e[] = Extrude {0, 0, H} { Surface{s}; Layers{n_layer}; Recombine; };
    fluid[] += e[1];
    walls[] += {s, e[0]};
    If (s <= 4)
        cylinder[] += e[5];
    EndIf
    If (s == 1 || s == 3)
        walls[] += e[3];
    EndIf
    If (s == 5)
        outlet = e[3];
        walls[] += {e[2], e[4]};
    EndIf
    If (s == 6)
        inlet = e[5];
        walls[] += {e[2], e[4]};
    EndIf
EndFor

Physical Surface("inlet") = {inlet};
Physical Surface("outlet") = {outlet};
Physical Surface("walls") = {walls[]};
Physical Surface("cylinder") = {cylinder[]};
Physical Volume("fluid") = {fluid[]};
