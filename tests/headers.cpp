// Nothing: what counts are the headers that are compiled with it, see CMakeLists.txt.
int main() {}
