"""Small-strain moduli of one period of a sheet: shells against voxels of a solid wall."""
