// An irregular mesh of tetrahedra: a block with a sloping face. Physical surface "base", curve "crest", point "toe".
SetFactory("Built-in");
Point(1) = {0, 0, 0, 0.9};
Point(2) = {3, 0, 0, 0.9};
Point(3) = {1, 0, 2, 0.6};
Point(4) = {0, 0, 2, 0.9};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
out[] = Extrude {0, 2, 0} { Surface{1}; };
Physical Point("toe") = {2};
Physical Curve("crest") = {2};
Physical Surface("base") = {out[2]};
Physical Surface(7) = {out[3]};
Physical Volume("soil") = {out[1]};
