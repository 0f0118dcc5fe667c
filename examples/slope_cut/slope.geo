// Background mesh of the slope: quadrilaterals of 0.4 m where the soil will move, triangles around them.
// Made with: gmsh -2 -format msh41 slope.geo -o slope.msh
h = 0.4;       // where the soil moves
far = 0.8;     // in the far corners

Point(1) = {0, 0, 0, far};      Point(2) = {45, 0, 0, far};
Point(3) = {45, 3, 0, h};       Point(4) = {45, 16.2, 0, h};
Point(5) = {9, 16.2, 0, h};     Point(6) = {0, 16.2, 0, far};
Point(7) = {9, 3, 0, h};

Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};
Line(5) = {5, 6};  Line(6) = {6, 1};  Line(7) = {7, 3};  Line(8) = {7, 5};

Curve Loop(1) = {7, 3, 4, -8};      Plane Surface(1) = {1};  // quadrilaterals
Curve Loop(2) = {1, 2, -7, 8, 5, 6}; Plane Surface(2) = {2};  // triangles

Transfinite Curve {7, 4} = 91;
Transfinite Curve {3, 8} = 34;
Transfinite Surface {1};
Recombine Surface {1};

Physical Curve("bottom") = {1};
Physical Curve("left") = {6};
Physical Curve("right") = {2, 3};
Physical Surface("background") = {1, 2};
