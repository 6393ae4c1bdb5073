// Unimate S-103 SCARA robot: the dimensions all parts share.
// Drawn for this project; licence BSD-3-Clause.  Millimetres, z up.
//
// FROM THE PAPER: only the joint offsets, in a unit that is not stated
// (y up there, turned to z up here).  EVERYTHING ELSE IS ASSUMED.

u = 25;                          // mm per unit of the paper -- assumed

// --- joint origins, from the paper ------------------------------------
j1_at = [ 0 * u, 0, 10    * u];  // joint 1 in the base frame
j2_at = [10 * u, 0, 14.6  * u];  // joint 2 in the arm 1 frame
j3_at = [14 * u, 0, 12.65 * u];  // joint 3 in the arm 2 frame

// --- heights of the link frames above the floor ------------------------
arm1_frame_z  = j1_at[2];                  // 250
arm2_frame_z  = arm1_frame_z + j2_at[2];   // 615
quill_frame_z = arm2_frame_z + j3_at[2];   // 931.25
L1 = j2_at[0];                             // 250, length of arm 1
L2 = j3_at[0];                             // 350, length of arm 2

// A part is written with heights above the floor (robot stretched out, the
// gripper up), and put into its link's frame by one of these.
module in_base()    { children(); }
module in_arm1()    { translate([0, 0, -arm1_frame_z])  children(); }
module in_arm2()    { translate([0, 0, -arm2_frame_z])  children(); }
module in_quill()   { translate([0, 0, -quill_frame_z]) children(); }
module in_gripper() { translate([0, 0, -quill_frame_z]) children(); }

// --- base (assumed) ----------------------------------------------------
plate_h      = 18;      // foot plate
plate_x      = [-138, 112];
plate_y      = 112;     // half width
ped_top      = 226;     // pedestal
base_top     = 246;     // top of the fixed flange of joint 1
flange_r     = 98;
panel_x      = -122;    // outer face of the connector panel

// --- arm 1 (assumed) ---------------------------------------------------
turret_bot   = 250;     // 4 mm of air above the base
turret_r     = 67;
arm1_bot     = 470;
arm1_top     = 572;
arm1_r1      = 77;      // at joint 1
arm1_r2      = 60;      // at joint 2
j2_gap_z     = 590;     // top of the bearing ring of joint 2
box_x        = [-128, -55];  // junction box behind the turret
box_top      = 548;
hose_r       = 13;

// --- arm 2 (assumed) ---------------------------------------------------
arm2_bot     = 592;
arm2_seam    = 668;     // casting below, cover above
arm2_top     = 732;
arm2_r1      = 64;      // at joint 2
arm2_r2      = 53;      // at joint 3
cap2_top     = 766;     // cap over joint 2
swivel_top   = 798;     // hose swivel on the axis of joint 2
tower_x      = [158, 296];
tower_y      = 42;
tower_top    = 886;

// --- quill (assumed) ---------------------------------------------------
quill_top    = 950;
quill_r      = 14;
nut_bot      = 572;     // lower end of the spline nut flange under arm 2
bellows_bot  = 500;
collar_bot   = 440;     // lower end of the quill

// --- gripper (assumed), heights with the gripper lifted ------------------
lift         = 60;      // travel
rod_r        = 9;
flange_bot   = 408;
palm_bot     = 378;
finger_bot   = 330;
