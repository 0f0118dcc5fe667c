/* A shared library that holds no UMAT. */
int nothing(void) {
  return 0;
}
