// the radius
r = 5; // [1:10]
h = 2.5; // [0:0.5:20]
m = 3; // [50]
s = 4; // 0.25
// pick one
k = 2; // [1, 2, 3]
sz = "M"; // [S, M, L]
lb = 10; // [10:Small, 20:Medium Size, 30:"Large one"]
b = true;
t = "abc"; // 8
u = "free";
v = [1, 2, 3]; // [0:0.1:10]
w = [1, 2, 3, 4, 5];
q = [1,"a"];
e = 1 + 2;
neg = -5; // [-10:10]
nolist = 7; // [1, 2, 3]
bad = 7; // hello world
badlist = 3; // [1, 2
two = 1; three = 2; // [0:9]
/* [Tab A] */
a1 = 1;
  // indented description
a2 = 2; /* no */ // [0:5]
/* [Tab B] [Sub] */
b1 = "x;//y"; // [x;//y:Label, z]

/* [Hidden] */
hid = 3;
/* [Global] */
$fn = 20; // [3:100]
und = undef;
rng = [0:5];
r = 6;
cube(1);
after = 4; // [1:9]
/* not a group */
str2 = "a,b"; // ["a,b", "c:d":Lab]
multi =
   4; // [1:8]
vec1=[1]; // [10]
vec4=[1,2,3,4]; // 0.5
module x() { in = 1; }
late = 5;
