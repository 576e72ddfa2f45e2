"""The terms of the energy, one file each: energy, gradient and Hessian in the paper's symbols."""
