"""Small-strain moduli of one period of a sheet: shells beside voxels of a solid wall."""
