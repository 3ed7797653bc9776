// SPDX-License-Identifier: GPL-3.0-or-later
//
// Channel of height 1 behind a step of height 1/2, with an inlet channel upstream of it.
// Quadrilaterals only, three rows of transfinite blocks; the step's corner is at (0, 0).
//
//     +------+---------------+---------+   y = 0.5
//     |      |               |         |
//     +------+---------------+---------+   y = 0
//            |               |         |
//            +---------------+---------+   y = -0.5
//   x = -2   0              15        30

// n: cells across the channel.
DefineConstant[ n = {16, Min 4, Max 200, Step 2, Name "Cells across"} ];

upstream = 2;
fine = 15;
L = 30;
n_up = n / 2;
n_in = Ceil(0.4 * upstream * n);
n_fine = Ceil(0.4 * fine * n);
n_far = Ceil(0.2 * (L - fine) * n);

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 0;
Mesh.RecombineAll = 0;

Point(1) = {-upstream, 0, 0};
Point(2) = {0, 0, 0};
Point(3) = {fine, 0, 0};
Point(4) = {L, 0, 0};
Point(5) = {-upstream, 0.5, 0};
Point(6) = {0, 0.5, 0};
Point(7) = {fine, 0.5, 0};
Point(8) = {L, 0.5, 0};
Point(9) = {0, -0.5, 0};
Point(10) = {fine, -0.5, 0};
Point(11) = {L, -0.5, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {9, 10};
Line(8) = {10, 11};
Line(9) = {1, 5};
Line(10) = {2, 6};
Line(11) = {3, 7};
Line(12) = {4, 8};
Line(13) = {9, 2};
Line(14) = {10, 3};
Line(15) = {11, 4};

Curve Loop(1) = {1, 10, -4, -9};
Curve Loop(2) = {2, 11, -5, -10};
Curve Loop(3) = {3, 12, -6, -11};
Curve Loop(4) = {7, 14, -2, -13};
Curve Loop(5) = {8, 15, -3, -14};
For s In {1:5}
    Plane Surface(s) = {s};
EndFor

Transfinite Curve {9:15} = n_up + 1;
Transfinite Curve {1, 4} = n_in + 1;
Transfinite Curve {2, 5, 7} = n_fine + 1;
Transfinite Curve {3, 6, 8} = n_far + 1;
Transfinite Surface {1:5};
Recombine Surface {1:5};

Physical Curve("inlet") = {9};
Physical Curve("outlet") = {12, 15};
Physical Curve("walls") = {1, 4, 5, 6, 7, 8, 13};
Physical Surface("fluid") = {1:5};
